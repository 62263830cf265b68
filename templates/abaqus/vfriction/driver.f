C     Calls VFRICTION as Abaqus/Explicit does, with a block of contact
C     points (see ftdriv in src/codegen/driver.h). States: 1 pressure,
C     2 speed, 3 slip, 4 work, 5 peak pressure, 6 temperature,
C     7 direction of slip.
      subroutine ftdriv(n, ns, v, np, prop, nf, field, nh, hist, tau)
      include 'vaba_param.inc'
@include fortran/ftdriv_arguments.f
      real*8 a
@if directs
      real*8 way(3), axis(3)
@end
C     Powers of two, as areas: dividing by them changes no bits.
      parameter (dtime = 2.0**(-30))
      character*80 cin, csec, cmain
      dimension ftan(2,n), st(8+2*nh,1,n), slip(3,n), stick(n)
      dimension prev(3,n), fnorm(n), area(n), dn(3,n), dsl(3,n)
      dimension shs(1,1), shm(4,n), xs(3,1,n), xm(3,4,n), vs(3,1,n)
      dimension vm(3,4,n), ts(n), tm(n), fs(nf,n), fm(nf,n), props(np)
      dimension jsec(1,n), jmain(4,n), jflags(3), rdata(4)
      nst = 8 + 2*nh
      cin = '@{contact}'
      csec = ' '
      cmain = ' '
      jflags = 1
      rdata = 0
      rdata(3) = dtime
      ftan = 0
      st = 0
      slip = 0
      prev = 0
C     What no law asks for
      dn = huge(dn)
      dsl = huge(dsl)
      shs = huge(shs)
      shm = huge(shm)
      xs = huge(xs)
      xm = huge(xm)
      vs = huge(vs)
      vm = huge(vm)
      jsec = 7
      jmain = 8
      do i = 1, np
        props(i) = real(prop(i), kind(props))
      end do
      do k = 1, n
        a = 2.0D0**(mod(k - 1, 4) - 2)
        area(k) = real(a, kind(area))
        fnorm(k) = real(v(1,k)*a, kind(fnorm))
        slip(1,k) = real(v(2,k)*dtime, kind(slip))
@if directs
        call ftway(v(7,k), way, axis)
        dsl(:,k) = real(way, kind(dsl))
        dn(:,k) = real(axis, kind(dn))
@end
C       Far more than friction holds, along and against the motion
        stick(k) = 1.0E30*(1 - 2*mod(k, 2))
        ts(k) = real(v(6,k), kind(ts))
        do i = 1, nf
          fs(i,k) = real(field(i,k), kind(fs))
        end do
C       Slip before the increment; what single precision rounds off the
C       sums lies behind them.
        call ftput(st(1,1,k), 1, 5, v(3,k) - abs(slip(1,k)), nst)
        call ftput(st(1,1,k), 2, 6, v(4,k), nst)
        call ftput(st(1,1,k), 3, 0, v(5,k), nst)
@if has_area
        hist(@{first_area},k) = hist(@{first_area},k)*a
@end
        do i = 1, nh
          call ftput(st(1,1,k), 6+i, 6+nh+i, hist(i,k), nst)
        end do
      end do
      tm = ts
      fm = fs
      call vfriction(ftan, st, n, n, 1, 1, 1, 4, 2, 3, nst, np, 1, nf,
     &  jflags, rdata, cin, csec, cmain, jsec, jmain, props, slip,
     &  stick, prev, fnorm, area, dn, dsl, shs, shm, xs, xm, vs, vm, ts,
     &  tm, fs, fm)
      do k = 1, n
        a = area(k)
        tau(k) = -ftan(1,k)/a*(1 - 2*mod(k, 2))
      end do
      end
C
@if directs
@include fortran/direction_vectors.f
@end
@include abaqus/put_state.f
C     One increment of VFRICTION (ftincr in src/codegen/driven_path.h).
C     par: time increment, whether there are temperatures, values of
C     the main surface (0, 1 or n), step, increment, directions of
C     friction, directions, columns of state variables. v: normal force,
C     area, stick force, motion (3), force before (3), temperatures (2),
C     point, first axis (3), normal (3). out: force (2).
      subroutine ftincr(n, npar, par, nv, v, ns, st, np, prop, nf,
     &  field, nout, out)
      include 'vaba_param.inc'
@include fortran/ftincr_arguments.f
      character*80 cin, csec, cmain
      dimension ftan(nint(par(6)),n)
      dimension state(ns/nint(par(8)),nint(par(8)),n)
      dimension slip(nint(par(7)),n), prev(nint(par(7)),n), stick(n)
      dimension fnorm(n), area(n), props(np), dn(3,n), dsl(3,n)
      dimension shs(4,n), shm(4,n), xs(3,4,n), xm(3,4,n), vs(3,4,n)
      dimension vm(3,4,n), ts(n), tm(n), fs(nf,n), fm(nf,n)
      dimension jsec(4,n), jmain(4,n), jflags(3), rdata(4)
      nfric = nint(par(6))
      ndir = nint(par(7))
      ncol = nint(par(8))
      nst = ns/ncol
      mains = nint(par(3))
      nsec = 1
      if (ncol .gt. 1) nsec = 2
      cin = '@{contact}'
      csec = ' '
      cmain = ' '
      jflags(1) = nint(par(4))
      jflags(2) = nint(par(5))
      jflags(3) = 9
      rdata(3) = real(par(1), kind(rdata))
      rdata(1) = 3*rdata(3)
      rdata(2) = 5*rdata(3)
      rdata(4) = 7*rdata(3)
C     What no law asks for
      dn = huge(dn)
      dsl = huge(dsl)
      shs = huge(shs)
      shm = huge(shm)
      xs = huge(xs)
      xm = huge(xm)
      vs = huge(vs)
      vm = huge(vm)
      jmain = 8
      ftan = 77
      do i = 1, np
        props(i) = real(prop(i), kind(props))
      end do
      do k = 1, n
        do i = 1, 4
          jsec(i,k) = 1000 + 7*k + i
        end do
        fnorm(k) = real(v(1,k), kind(fnorm))
        area(k) = real(v(2,k), kind(area))
        stick(k) = real(v(3,k), kind(stick))
        do i = 1, ndir
          slip(i,k) = real(v(3+i,k), kind(slip))
          prev(i,k) = real(v(6+i,k), kind(prev))
@if directs
          dsl(i,k) = real(v(12+i,k), kind(dsl))
          dn(i,k) = real(v(15+i,k), kind(dn))
@end
        end do
        ts(k) = real(v(10,k), kind(ts))
        tm(k) = real(v(11,k), kind(tm))
        do i = 1, nf
          fs(i,k) = real(field(i,k), kind(fs))
          fm(i,k) = real(field(nf+i,k), kind(fm))
        end do
        do j = 1, ncol
          do i = 1, nst
            state(i,j,k) = real(st((j-1)*nst+i,k), kind(state))
          end do
        end do
      end do
      call vfriction(ftan, state, n, mains, 1, ncol, nsec, 4, nfric,
     &  ndir, nst, np, nint(par(2)), nf, jflags, rdata, cin, csec,
     &  cmain, jsec, jmain, props, slip, stick, prev, fnorm, area, dn,
     &  dsl, shs, shm, xs, xm, vs, vm, ts, tm, fs, fm)
      out = 0
      do k = 1, n
        do i = 1, nfric
          out(i,k) = ftan(i,k)
        end do
        do j = 1, ncol
          do i = 1, nst
            st((j-1)*nst+i,k) = state(i,j,k)
          end do
        end do
      end do
      end
