C     Calls VFRIC_COEF as Abaqus/Explicit does, with a block of contact
C     points (see ftdriv in src/codegen/driver.h). States: 1 pressure,
C     2 speed, 3 temperature.
      subroutine ftdriv(n, ns, v, np, prop, nf, field, nh, hist, tau)
      include 'vaba_param.inc'
@include fortran/ftdriv_arguments.f
      character*80 cin, csec, cmain
      dimension coef(n), deriv(n,3), props(np), rate(n), press(n)
      dimension temp(n), fav(n,nf), jflags(2), rdata(3)
      cin = '@{contact}'
      csec = ' '
      cmain = ' '
      jflags = 1
      rdata = 0
      coef = 0
      deriv = 0
      do i = 1, np
        props(i) = real(prop(i), kind(props))
      end do
      do k = 1, n
        press(k) = real(v(1,k), kind(press))
        rate(k) = real(v(2,k), kind(rate))
        temp(k) = real(v(3,k), kind(temp))
        do i = 1, nf
          fav(k,i) = real(field(i,k), kind(fav))
        end do
      end do
      call vfric_coef(coef, deriv, n, np, 1, nf, jflags, rdata, cin,
     &  csec, cmain, props, rate, press, temp, fav)
      tau = coef
      end
C
C     One call of VFRIC_COEF (ftincr in src/codegen/driven_path.h).
C     par: whether there are temperatures. v: pressure, slip rate, slip
C     (not given), temperature. out: coefficient; derivatives, which
C     have to be 0.
      subroutine ftincr(n, npar, par, nv, v, ns, st, np, prop, nf,
     &  field, nout, out)
      include 'vaba_param.inc'
@include fortran/ftincr_arguments.f
      character*80 cin, csec, cmain
      dimension coef(n), deriv(n,3), props(np), rate(n), press(n)
      dimension temp(n), fav(n,nf), jflags(2), rdata(3)
      cin = '@{contact}'
      csec = ' '
      cmain = ' '
      jflags(1) = 2
      jflags(2) = 11
      rdata(1) = 0.25
      rdata(2) = 0.5
      rdata(3) = 0.125
      coef = 0.125
      deriv = 77
      do i = 1, np
        props(i) = real(prop(i), kind(props))
      end do
      do k = 1, n
        press(k) = real(v(1,k), kind(press))
        rate(k) = real(v(2,k), kind(rate))
        temp(k) = real(v(4,k), kind(temp))
        do i = 1, nf
          fav(k,i) = real(field(i,k), kind(fav))
        end do
      end do
      call vfric_coef(coef, deriv, int(n), int(np), nint(par(1)),
     &  int(nf), jflags, rdata, cin, csec, cmain, props, rate, press,
     &  temp, fav)
      do k = 1, n
        out(1,k) = coef(k)
        out(2,k) = sum(abs(deriv(k,:)))
      end do
      end
