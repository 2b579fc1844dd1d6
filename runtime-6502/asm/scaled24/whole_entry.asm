; The product of two numbers of 24 bits, a in a, x and y (high), b in arg: all of it but its
; lowest byte, in prod+1 to prod+4 and a (high).
whole24:
