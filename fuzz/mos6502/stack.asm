; Subroutines, the stack, decimal mode, pointers.
at = $10
* = $C000
      sed
      ldy #$20
loop: tya
      pha
      jsr double
      sta (at),y
      adc (at,x)
      ror a
      pla
      tay
      dey
      bpl loop
      cld
      php
      plp
      jmp ($FFFC)
double: clc
      adc at + 1
      rts
