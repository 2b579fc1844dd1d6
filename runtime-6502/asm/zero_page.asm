; The runtime's zero page. Numbers are 32 bits, two's complement, low byte first.
acc = $00         ; first operand, and the result
arg = $04         ; second operand
prod = $08        ; 64 bits: a product; a remainder and a root
sign = $10        ; bit 7: the result is negative
mixed = $11       ; bit 7: the divisor is negative
carried = $12     ; what one column of a product hands to the next
low = $13         ; low byte of a product of two bytes
bits = $14        ; bits on their way out of one byte, and into another
count = $15
sum_lo = $16      ; pointers into the quarter squares: f(x + y), f(x - y)
sum_hi = $18
dif_lo = $1a
dif_hi = $1c
