//! The functions of BASIC that routines need: lines without numbers.
//!
//! A part that is no DEF is done once, before anything else: the limits are variables because BASIC
//! II takes long over large literals. A false IF goes to the first ELSE on its line, so there is never more than one. Their bytes
//! are those of the tokenised lines.

use slowlight_routine::{Part, Source};

macro_rules! part {
    ($name:literal [$($need:literal),*] $bytes:literal $text:literal) => {
        Part { name: $name, source: Source::Text($text), needs: &[$($need),*], bytes: $bytes, starts: 0 }
    };
}

#[rustfmt::skip]
pub(crate) static ALL: &[Part] = &[
    part!("BIG" [] 71 "\
BIG=1.7E38:HALF=BIG/2:ROOT=1E18:TINY=1E-15:FAR=1E33:WIDE=2147483648
"),
    // A variable takes 1,300 cycles less than the number would in an expression.
    part!("MIDWAY" [] 14 "\
MIDWAY=0.5
"),
    part!("QUARTER" [] 15 "\
QUARTER=PI/2
"),
    part!("FNadd" ["BIG"] 97 "\
DEF FNadd(a,b)
IF ABS(a)<HALF THEN IF ABS(b)<HALF THEN =a+b
IF ABS(a/2+b/2)<HALF THEN =a+b ELSE =SGN(a/2+b/2)*BIG
"),
    part!("FNsub" ["FNadd"] 66 "\
DEF FNsub(a,b)
IF ABS(a)<HALF THEN IF ABS(b)<HALF THEN =a-b
=FNadd(a,-b)
"),
    part!("FNneg" [] 16 "\
DEF FNneg(a)=-a
"),
    part!("FNabs" [] 18 "\
DEF FNabs(a)=ABS(a)
"),
    part!("FNmul" ["BIG"] 115 "\
DEF FNmul(a,b)
IF ABS(a)<ROOT THEN IF ABS(b)<ROOT THEN =a*b
IF ABS(b)<=1 THEN =a*b
IF ABS(a)<=BIG/ABS(b) THEN =a*b ELSE =SGN(a)*SGN(b)*BIG
"),
    part!("FNdiv" ["BIG"] 115 "\
DEF FNdiv(a,b)
IF ABS(a)<ROOT THEN IF ABS(b)>TINY THEN =a/b
IF b=0 THEN =SGN(a)*FAR
IF ABS(a/FAR)>ABS(b) THEN =SGN(a)*SGN(b)*FAR ELSE =a/b
"),
    part!("FNsqr" [] 35 "\
DEF FNsqr(a)
IF a>0 THEN =SQR(a) ELSE =0
"),
    part!("FNmin" [] 34 "\
DEF FNmin(a,b)
IF b<a THEN =b ELSE =a
"),
    part!("FNmax" [] 34 "\
DEF FNmax(a,b)
IF b>a THEN =b ELSE =a
"),
    part!("FNmod" [] 188 "\
DEF FNmod(a,b)
LOCAL c,d
IF b=0 THEN =0
c=ABS(a):d=ABS(b)
IF d<=c/2 THEN REPEAT:d=d*2:UNTIL d>c/2
REPEAT
IF c>=d THEN c=c-d
d=d/2
UNTIL d<ABS(b) OR d=0
IF a<0 THEN c=-c
IF c<>0 AND (c<0)<>(b<0) THEN =c+b ELSE =c
"),
    // A little below 0 the quotient might vanish: that is not floored to -1.
    part!("FNrem" ["BIG"] 58 "\
DEF FNrem(a,b)
IF a<0 THEN IF a>-TINY THEN =a+b
=a-INT(a/b)*b
"),
    // The divisor in two halves, whose products with the quotient are exact (Dekker 1971). The quotient may
    // be rounded up to a whole number, so one divisor may have to be added; never down past one.
    part!("FNrest" [] 94 "\
DEF FNrest(a,b)
LOCAL c,d
c=b*65537:d=c-(c-b):c=INT(a/b):a=a-c*d-c*(b-d)
IF a<0 THEN =a+b ELSE =a
"),
    part!("FNfloor" ["BIG"] 78 "\
DEF FNfloor(a)
IF ABS(a)<WIDE THEN =INT(a)
IF a>0 THEN =2147483647 ELSE =-2147483647-1
"),
    part!("FNround" ["BIG", "MIDWAY"] 129 "\
DEF FNround(a)
IF ABS(a)<WIDE-1 THEN =SGN(a)*INT(ABS(a)+MIDWAY)
IF a>0 THEN =2147483647
IF a>MIDWAY-WIDE THEN =-2147483647 ELSE =-2147483647-1
"),
    part!("FNangle" ["FNmod"] 49 "\
DEF FNangle(a)
IF ABS(a)<1E5 THEN =a ELSE =FNmod(a,2*PI)
"),
    part!("FNtan" ["FNangle", "FNdiv"] 45 "\
DEF FNtan(a)=FNdiv(SIN(FNangle(a)),COS(FNangle(a)))
"),
    part!("FNclamp" [] 40 "\
DEF FNclamp(a)
IF ABS(a)>1 THEN =SGN(a) ELSE =a
"),
    part!("FNatan2" ["QUARTER"] 121 "\
DEF FNatan2(a,b)
IF ABS(a)>ABS(b) THEN =SGN(a)*QUARTER-ATN(b/a)
IF b>0 THEN =ATN(a/b)
IF b=0 THEN =0
IF a<0 THEN =ATN(a/b)-PI ELSE =ATN(a/b)+PI
"),
    part!("FNexp" ["BIG"] 54 "\
DEF FNexp(a)
IF a>88 THEN =BIG
IF a<-88 THEN =0 ELSE =EXP(a)
"),
    part!("FNln" ["BIG"] 37 "\
DEF FNln(a)
IF a>0 THEN =LN(a) ELSE =-BIG
"),
    part!("FNpow" ["BIG", "FNmod", "FNexp", "FNmul"] 169 "\
DEF FNpow(a,b)
LOCAL c,d
IF b=0 THEN =1
IF a=0 AND b<0 THEN =BIG
IF a=0 THEN =0
d=1
IF a<0 THEN c=FNmod(b,2):IF c<>c^2 THEN =0
IF a<0 AND c<>0 THEN d=-1
=d*FNexp(FNmul(b,LN(ABS(a))))
"),
    // The floor of a whole real is itself; a call for it takes a quarter of the whole.
    part!("FNiadd" ["FNfloor"] 58 "\
DEF FNiadd(a,b)
a=a+b
IF ABS(a)<WIDE THEN =a ELSE =FNfloor(a)
"),
    part!("FNisub" ["FNfloor"] 58 "\
DEF FNisub(a,b)
a=a-b
IF ABS(a)<WIDE THEN =a ELSE =FNfloor(a)
"),
    part!("FNimul" ["FNfloor"] 58 "\
DEF FNimul(a,b)
a=a*b
IF ABS(a)<WIDE THEN =a ELSE =FNfloor(a)
"),
    part!("FNineg" ["BIG"] 47 "\
DEF FNineg(a)
IF a>-WIDE THEN =-a ELSE =2147483647
"),
    part!("FNimin" [] 41 "\
DEF FNimin(a%,b%)
IF b%<a% THEN =b% ELSE =a%
"),
    part!("FNimax" [] 41 "\
DEF FNimax(a%,b%)
IF b%>a% THEN =b% ELSE =a%
"),
    // The least integer has neither quotient nor rest on the ROM.
    part!("FNidiv" ["FNineg"] 201 "\
DEF FNidiv(a%,b%)
IF b%=-1 THEN =FNineg(a%)
IF a%<-2147483647 AND b%<>0 THEN =FNidiv(a%+ABS(b%),b%)-SGN(b%)
IF b%<>0 THEN =a% DIV b%+((a% MOD b%<>0) AND ((a%<0)<>(b%<0)))
IF a%<0 THEN =-2147483647-1 ELSE =2147483647*SGN(a%)
"),
    part!("FNimod" [] 133 "\
DEF FNimod(a%,b%)
IF b%=0 THEN =0
IF a%<-2147483647 THEN =FNimod(a%+ABS(b%),b%)
IF a% MOD b%<>0 AND (a%<0)<>(b%<0) THEN =a% MOD b%+b% ELSE =a% MOD b%
"),
];
