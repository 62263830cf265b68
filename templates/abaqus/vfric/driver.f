C     Calls VFRIC as Abaqus/Explicit does, with a block of contact
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
      dimension ftan(2,n), st(8+2*nh,n+3), slip(3,n), stick(n)
      dimension prev(3,n), fnorm(n), shape(4,n), area(n+3)
      dimension xsec(3,n+3), xmain(3,4), dsl(3,n), dn(3,n), props(np)
      dimension tsec(n), psec(n,nf), tmain(n), pmain(n,nf)
      dimension jsec(n+3), jmain(4), jcs(n), jcm(4,n)
      nst = 8 + 2*nh
      cin = '@{contact}'
      csec = 'SEC'
      cmain = 'MAIN'
      ftan = 0
      st = 0
      slip = 0
      prev = 0
      shape = 0
      area = 1
      xsec = 0
      xmain = 0
      dsl = 0
      dn = 0
      jsec = 7
      jmain = 8
      jcm = 1
      do i = 1, np
        props(i) = real(prop(i), kind(props))
      end do
      do k = 1, n
C       Nodes backwards, and not from the first
        node = n - k + 3
        jcs(k) = node
        a = 2.0D0**(mod(node - 1, 4) - 2)
        area(node) = real(a, kind(area))
        fnorm(k) = real(v(1,k)*a, kind(fnorm))
        slip(1,k) = real(v(2,k)*dtime, kind(slip))
@if directs
        call ftway(v(7,k), way, axis)
        dsl(:,k) = real(way, kind(dsl))
        dn(:,k) = real(axis, kind(dn))
@end
C       Far more than friction holds, along and against the motion
        stick(k) = 1.0E30*(1 - 2*mod(k, 2))
        tsec(k) = real(v(6,k), kind(tsec))
        do i = 1, nf
          psec(k,i) = real(field(i,k), kind(psec))
        end do
C       Slip before the increment; what single precision rounds off the
C       sums lies behind them.
        call ftput(st(1,node), 1, 5, v(3,k) - abs(slip(1,k)), nst)
        call ftput(st(1,node), 2, 6, v(4,k), nst)
        call ftput(st(1,node), 3, 0, v(5,k), nst)
@if has_area
        hist(@{first_area},k) = hist(@{first_area},k)*a
@end
        do i = 1, nh
          call ftput(st(1,node), 6+i, 6+nh+i, hist(i,k), nst)
        end do
      end do
      tmain = tsec
      pmain = psec
      call vfric(ftan, st, 1, 1, n, 4, n+3, 4, 2, 3, nst, np, 1, nf, n,
     &  jsec, jmain, jcs, jcm, 0*dtime, 0*dtime, dtime, cin, csec,
     &  cmain, 1, slip, stick, prev, fnorm, 0*dtime, shape, xsec, xmain,
     &  dsl, dn, props, area, tsec, psec, tmain, pmain)
      do k = 1, n
        a = area(jcs(k))
        tau(k) = -ftan(1,k)/a*(1 - 2*mod(k, 2))
      end do
      end
C
@if directs
@include fortran/direction_vectors.f
@end
@include abaqus/put_state.f
C     One increment of VFRIC (ftincr in src/codegen/driven_path.h).
C     par: time increment, whether there are temperatures, values of
C     the main surface (0, 1 or n), step, increment, directions of
C     friction, directions, surface nodes. v: normal force, area, stick
C     force, motion (3), force before (3), temperatures (2), node, first
C     axis (3), normal (3). out: force (2), values of other nodes that
C     were changed.
      subroutine ftincr(n, npar, par, nv, v, ns, st, np, prop, nf,
     &  field, nout, out)
      include 'vaba_param.inc'
@include fortran/ftincr_arguments.f
      character*80 cin, csec, cmain
      dimension ftan(nint(par(6)),n), state(ns,nint(par(8)))
      dimension slip(nint(par(7)),n), prev(nint(par(7)),n), stick(n)
      dimension fnorm(n), shape(4,n), area(nint(par(8))), props(np)
      dimension xsec(nint(par(7)),nint(par(8))), xmain(nint(par(7)),4)
      dimension dsl(nint(par(7)),n), dn(nint(par(7)),n)
      dimension tsec(n), psec(n,nf), tmain(n), pmain(n*nf+1)
      dimension jsec(nint(par(8))), jmain(4), jcs(n), jcm(4,n)
      nfric = nint(par(6))
      ndir = nint(par(7))
      nodes = nint(par(8))
      mains = nint(par(3))
      cin = '@{contact}'
      csec = 'SEC'
      cmain = 'MAIN'
      dtime = real(par(1), kind(dtime))
C     What no law asks for, and state variables of other nodes
      shape = huge(shape)
      xsec = huge(xsec)
      xmain = huge(xmain)
      dsl = huge(dsl)
      dn = huge(dn)
      jcm = 1
      state = -5.25
      area = 3.5
      ftan = 77
      do i = 1, nodes
        jsec(i) = 1000 + 7*i
      end do
      jmain = 8
      do i = 1, np
        props(i) = real(prop(i), kind(props))
      end do
      do k = 1, n
        node = nint(v(12,k))
        jcs(k) = node
        fnorm(k) = real(v(1,k), kind(fnorm))
        area(node) = real(v(2,k), kind(area))
        stick(k) = real(v(3,k), kind(stick))
        do i = 1, ndir
          slip(i,k) = real(v(3+i,k), kind(slip))
          prev(i,k) = real(v(6+i,k), kind(prev))
@if directs
          dsl(i,k) = real(v(12+i,k), kind(dsl))
          dn(i,k) = real(v(15+i,k), kind(dn))
@end
        end do
        tsec(k) = real(v(10,k), kind(tsec))
        tmain(k) = real(v(11,k), kind(tmain))
        do i = 1, nf
          psec(k,i) = real(field(i,k), kind(psec))
          if (k .le. mains)
     &      pmain((i-1)*mains+k) = real(field(nf+i,k), kind(pmain))
        end do
        do i = 1, ns
          state(i,node) = real(st(i,k), kind(state))
        end do
      end do
      call vfric(ftan, state, nint(par(4)), nint(par(5)), n, 4, nodes,
     &  4, nfric, ndir, ns, np, nint(par(2)), nf, mains, jsec, jmain,
     &  jcs, jcm, 3*dtime, 5*dtime, dtime, cin, csec, cmain, 1, slip,
     &  stick, prev, fnorm, 9*dtime, shape, xsec, xmain, dsl, dn, props,
     &  area, tsec, psec, tmain, pmain)
      out = 0
      do k = 1, n
        do i = 1, nfric
          out(i,k) = ftan(i,k)
        end do
        do i = 1, ns
          st(i,k) = state(i,jcs(k))
          state(i,jcs(k)) = -5.25
        end do
      end do
      do j = 1, nodes
        do i = 1, ns
          if (abs(state(i,j) + 5.25) .gt. 0) out(3,1) = out(3,1) + 1
        end do
      end do
      end
