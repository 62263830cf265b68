C     Sets a state variable, and another one to what is rounded off it.
      subroutine ftput(st, i, j, value, nst)
      include 'vaba_param.inc'
      dimension st(nst)
      real*8 value
      st(i) = real(value, kind(st))
      if (j .gt. 0) st(j) = real(value - st(i), kind(st))
      end
C
