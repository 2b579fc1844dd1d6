; Pages of distances with an upper byte each, and from where it lies behind the lower one.
log_sums_pages = 10
log_lost_pages = 11
log_pages = 24
