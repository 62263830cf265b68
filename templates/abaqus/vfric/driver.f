C     Calls VFRIC as Abaqus/Explicit does, with a block of contact
C     points (see ftdriv in src/codegen/driver.h). States: 1 pressure,
C     2 speed, 3 slip, 4 work, 5 peak pressure, 6 temperature.
      subroutine ftdriv(n, ns, v, np, prop, nf, field, nh, hist, tau)
      include 'vaba_param.inc'
      integer*4 n, ns, np, nf, nh
      real*8 v(ns,n), prop(np), field(nf,n), hist(nh,n), tau(n), a
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
C     Sets a state variable, and another one to what is rounded off it.
      subroutine ftput(st, i, j, value, nst)
      include 'vaba_param.inc'
      dimension st(nst)
      real*8 value
      st(i) = real(value, kind(st))
      if (j .gt. 0) st(j) = real(value - st(i), kind(st))
      end
