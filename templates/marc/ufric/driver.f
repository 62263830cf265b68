C     Calls UFRIC as Marc does, once per contact point (see ftdriv in
C     src/codegen/driver.h). States: 1 normal stress, 2 speed,
C     3 temperature, 4 flow stress, 5 direction of slip.
      subroutine ftdriv(n, ns, v, np, prop, nf, field, nh, hist, tau)
      implicit none
@include fortran/ftdriv_arguments.f
      integer mibody(4), inc, nsurf, k
      double precision coord(3), vrel(2), temp(2), time
      mibody(1) = 11
      mibody(2) = 2
      mibody(3) = 1
      mibody(4) = 7
      coord = 0.0D0
      time = 0.0D0
      inc = 1
      nsurf = @{contact}
      do k = 1, n
        vrel(1) = v(2,k)
        vrel(2) = 0.0D0
@if directs
        vrel(1) = v(2,k)*cos(v(5,k)/57.29577951308232D0)
        vrel(2) = v(2,k)*sin(v(5,k)/57.29577951308232D0)
        where (abs(vrel) .lt. v(2,k)*1.0D-15) vrel = 0.0D0
@end
        temp(1) = v(3,k)
        temp(2) = 0.0D0
        tau(k) = 777.0D0
        call ufric(mibody, coord, v(1,k), vrel, temp, v(4,k), tau(k),
     &    time, inc, nsurf)
      end do
      end
C
C     UFRIC at each point (ftincr in src/codegen/driven_path.h).
C     v: normal stress, speed, slip (not given), temperature, flow
C     stress, direction of the speed (2).
      subroutine ftincr(n, npar, par, nv, v, ns, st, np, prop, nf,
     &  field, nout, out)
      implicit none
@include fortran/ftincr_arguments.f
      integer mibody(4), inc, nsurf, k
      double precision coord(3), vrel(2), temp(2), time
      mibody(1) = 13
      mibody(2) = 5
      mibody(3) = 4
      mibody(4) = 9
      coord = huge(coord)
      time = 0.375D0
      inc = 17
      nsurf = @{contact}
      do k = 1, n
@if in_space
        vrel(1) = v(6,k)*v(2,k)
        vrel(2) = v(7,k)*v(2,k)
@else
        vrel(1) = v(2,k)
        vrel(2) = 1.0D30
@end
        temp(1) = v(4,k)
        temp(2) = 1.0D30
        out(1,k) = 0.125D0
        out(2,k) = 0
        call ufric(mibody, coord, v(1,k), vrel, temp, v(5,k), out(1,k),
     &    time, inc, nsurf)
      end do
      end
