; Reals of five bytes: the mantissa, low byte first, the sign in place of its leading bit, and
; the exponent, 128 more than it is; of 0 all are 0.
fa = $1e             ; first operand, and the result
fb = $23             ; second operand
float_guard = $28    ; what is below the last place of a mantissa
float_exp = $29      ; an exponent under way, of 16 bits
float_sign = $2b     ; bit 7: the result is negative
float_unlike = $2c   ; bit 7: signs are unlike
float_t = $2d        ; lower bytes of products
float_u = $30        ; upper bytes
float_n = $34        ; a whole part; how many terms are left
float_mask = $35
float_y = $36
float_at = $37       ; pointer to a series
float_x = $39        ; a number kept: five bytes
float_quad = $3e     ; a quadrant
