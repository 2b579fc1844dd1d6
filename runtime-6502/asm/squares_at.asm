; Quarter squares, f(n) = floor(n n / 4), made once at the start.
; a b = f(a + b) - f(a - b), exactly: a + b and a - b are both even or both odd.
sqr_lo = $0200    ; f(n), low bytes, n = 0 to 511
sqr_hi = $0400    ; high bytes
sqd_lo = $0600    ; f(n - 255), n = 0 to 510
sqd_hi = $0800

make_squares:
