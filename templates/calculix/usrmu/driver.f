C     Calls USRMU as the lines put into CalculiX do (see ftdriv in
C     src/codegen/driver.h). States: 1 pressure, 2 speed, 3 sliding
C     distance, 4 temperature.
      subroutine ftdriv(n, ns, v, np, prop, nf, field, nh, hist, tau)
      implicit none
      integer*4 n, ns, np, nf, nh
      real*8 v(ns,n), prop(np), field(nf,n), hist(nh,n), tau(n)
C     A power of two: dividing by it changes no bits.
      real*8 step, al(3), xn(3), t(3)
      parameter (step = 2.0D0**(-30))
      integer i, j, k, point
      save point
      data point /0/
      call usrmu_time(step)
      do k = 1, n
C       Along one axis; what moves along the normal is no slip.
        point = point + 1
        i = 1 + mod(point, 3)
        j = 1 + mod(point + 1, 3)
        al = 0.0D0
        xn = 0.0D0
        t = 0.0D0
        al(i) = v(2,k)*step
        t(i) = v(3,k)
        xn(j) = 1.0D0
        al(j) = 3.0D0
        tau(k) = 0.1D0
        call usrmu(tau(k), v(1,k), al, xn, al(j), t, v(4,k))
      end do
      end
