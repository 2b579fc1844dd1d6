; Logarithms of 10 bits behind the point: pages of an octave, and some numbers.
log_octave = 4
log_of_quarter = 667    ; a quarter turn
log_of_half_turn = 1691   ; half a turn
log_of_eighth = 65179  ; an eighth of a turn
log_of_natural = 10781  ; what an int of units is too large by to be a natural logarithm
log_of_steep = 64234  ; the root of 2 less 1
log_of_short_series = 59904  ; below it a series is its first term
; Pages of distances with an upper byte each, and from where it lies behind the lower one.
log_sums_pages = 10
log_lost_pages = 11
log_pages = 24
