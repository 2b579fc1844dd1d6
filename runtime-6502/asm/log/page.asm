; Pointers into the tables of logarithms: the low bytes stay, the high ones are set at each use.
sums_at = $1e        ; low bytes of what a sum adds
sums_up = $20        ; high bytes
lost_at = $22        ; the same of what a difference adds, which is below 0
lost_up = $24
parts_at = $26       ; mantissas of logarithms
; Logarithms under way.
log_x = $28
log_z = $2a
log_c = $2c
log_n = $2e
log_side = $30       ; a sign
log_quarter = $31
; As sums_at and the others, one further: for distances of which the complement is known.
less_sums_at = $32
less_sums_up = $34
less_lost_at = $36
less_lost_up = $38
; Where operands of ints go that have to be extended, and results of which a part is kept.
first = $00
second = $04
third = $08
