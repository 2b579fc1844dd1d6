; Opens a picture of 4 x 2 pixels in 3 inks and fills it.
width = 4
* = $0800
start:
      lda #<(width)
      sta $FF00
      lda #>(width)
      sta $FF01
      lda #2
      sta $FF02
      lda #3
      sta $FF04
      ldx #width * 2
next: lda inks,x
      sta $FF09
      dex
      bne next
      lda #0
      sta $FF0A
inks: .byte 0, 1, 2, $00, %10, 'a' - 96, "bc", 1
      .word start, inks + 2
      .res 3, 255
