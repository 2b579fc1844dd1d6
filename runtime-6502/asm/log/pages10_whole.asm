; Pages of distances with an upper byte each, and from where it lies behind the lower one.
log_sums_pages = 23
log_lost_pages = 23
log_pages = 24
