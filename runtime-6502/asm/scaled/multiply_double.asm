; The product's upper 17 bits but the first, rounded, in prod+2 and a (high).
multiply15:
        jsr product16
double16:
        asl prod+1
        rol prod+2
        rol
        jmp round16
