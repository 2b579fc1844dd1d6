; What fixed point of 24 bits keeps in the zero page beside that of 16.
sum2_lo = $34     ; pointers into the quarter squares for an operand's third byte
sum2_hi = $36
dif2_lo = $38
dif2_hi = $3a
part = $3c        ; what lies between two entries of a table: 16 bits
beside = $3e      ; more parts of a product
beneath = $3f
