C     Calls USRMU as the lines put into CalculiX do (see ftdriv in
C     src/codegen/driver.h). States: 1 pressure, 2 speed, 3 sliding
C     distance, 4 temperature, 5 direction of slip.
      subroutine ftdriv(n, ns, v, np, prop, nf, field, nh, hist, tau)
      implicit none
@include fortran/ftdriv_arguments.f
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
@if directs
        call ftway(v(5,k), al, xn)
        al = v(2,k)*step*al
        call usrmu(tau(k), v(1,k), al, xn, 0.0D0, t, v(4,k))
@else
        call usrmu(tau(k), v(1,k), al, xn, al(j), t, v(4,k))
@end
      end do
      end
C
@if directs
@include fortran/direction_vectors.f
@end
C     USRMU at each point (ftincr in src/codegen/driven_path.h).
C     v: pressure, speed, slip, temperature, flow stress, direction of
C     the speed (2).
      subroutine ftincr(n, npar, par, nv, v, ns, st, np, prop, nf,
     &  field, nout, out)
      implicit none
@include fortran/ftincr_arguments.f
      real*8 step, al(3), xn(3), t(3), across
      integer k
C     Along the normal (2,-1,2)/3 something moves that is no slip, which
C     is along (1,2,0)/sqrt(5).
@if directs
C     Here it is along that and across it, (-4,2,5)/sqrt(45).
@end
      across = 1.0D0/sqrt(5.0D0)
      do k = 1, n
        step = 2.0D0**(-20 - mod(k, 3))
        if (abs(v(2,k)) .le. 0.0D0) step = 0
        call usrmu_time(step)
        xn(1) = 2.0D0/3.0D0
        xn(2) = -1.0D0/3.0D0
        xn(3) = 2.0D0/3.0D0
        al = 0.5D0*v(2,k)*step*xn
        al(1) = al(1) + v(2,k)*step*across
        al(2) = al(2) + v(2,k)*step*2.0D0*across
@if directs
        al = 0.5D0*v(2,k)*step*xn
        al(1) = al(1) + v(2,k)*step*(v(6,k) - v(7,k)*4.0D0/3)*across
        al(2) = al(2) + v(2,k)*step*(2*v(6,k) + v(7,k)*2.0D0/3)*across
        al(3) = al(3) + v(2,k)*step*v(7,k)*5.0D0/3*across
@end
        t(1) = 0.48D0*v(3,k)
        t(2) = 0.6D0*v(3,k)
        t(3) = -0.64D0*v(3,k)
        out(1,k) = 0.125D0
        out(2,k) = 0
        call usrmu(out(1,k), v(1,k), al, xn, 0.5D0*v(2,k)*step, t,
     &    v(4,k))
      end do
      end
