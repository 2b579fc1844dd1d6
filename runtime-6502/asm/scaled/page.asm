; What fixed point with points of its own keeps in the zero page beside that.
first = $1e       ; an operand read at another scale: four bytes
second = $22
third = $26       ; a result that is cut to the bytes of its home
sum1_lo = $2a     ; pointers into the quarter squares for an operand's upper byte
sum1_hi = $2c
dif1_lo = $2e
dif1_hi = $30
across = $32      ; parts of a product
above = $33
