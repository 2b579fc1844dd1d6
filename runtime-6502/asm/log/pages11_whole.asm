; Pages of distances with an upper byte each, and from where it lies behind the lower one.
log_sums_pages = 28
log_lost_pages = 30
log_pages = 43
