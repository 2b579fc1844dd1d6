; The product of two numbers of 24 bits, a in a, x and y (high), b in arg: its upper 32 bits
; in prod+2, prod+3, prod+4 and a (high). Of what is below only the upper bytes of a0 b1 and
; a1 b0 are added, so it is a few of the 32 bits' units off.
product24:
