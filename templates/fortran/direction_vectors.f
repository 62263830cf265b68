C     Unit vectors of a slip t at this angle (degrees) from the reference
C     direction, and of a normal a across that.
      subroutine ftway(angle, t, a)
      implicit none
      real*8 angle, t(3), a(3), to(3), c, s
      integer i
      to(1) = @{reference_1}
      to(2) = @{reference_2}
      to(3) = @{reference_3}
      i = 1 + mod(maxloc(abs(to), 1), 3)
      a = 0
      a(i) = 1
      a = a - to(i)*to
      a = a/norm2(a)
      c = cos(angle/57.29577951308232D0)
      s = sin(angle/57.29577951308232D0)
      if (abs(c) .lt. 1.0D-15) c = 0
      if (abs(s) .lt. 1.0D-15) s = 0
      t(1) = c*to(1) + s*(to(2)*a(3) - to(3)*a(2))
      t(2) = c*to(2) + s*(to(3)*a(1) - to(1)*a(3))
      t(3) = c*to(3) + s*(to(1)*a(2) - to(2)*a(1))
      end
C
