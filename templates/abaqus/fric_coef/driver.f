C     Calls FRIC_COEF as Abaqus/Standard does (see ftdriv in
C     src/codegen/driver.h). States: 1 pressure, 2 slip rate,
@if new
C     3 temperature, 4 slip, 5 work, 6 peak pressure, 7 direction of
C     slip. State variables are there where a call holds one point.
@else
C     3 temperature.
@end
      subroutine ftdriv(n, ns, v, np, prop, nf, field, nh, hist, tau)
      include 'aba_param.inc'
@include fortran/ftdriv_arguments.f
      character*80 cin, csl, cms
      dimension press(n), temp(n), fav(n,nf)
@if new
      dimension coef(n,2), deriv(n,20,2), slip(n,6), rdata(18+2*nh)
      dimension idata(6)
@else
      dimension coef(n), deriv(n,3), slip(n), rdata(3), idata(2)
@end
      cin = '@{contact}'
      csl = 'SEC'
      cms = 'MAIN'
      nprops = np
      nfield = nf
      rdata = 0
      rdata(3) = 1
      idata = 1
      press = v(1,:)
      temp = v(3,:)
      fav = transpose(field)
@if new
      slip = 0
      slip(:,1) = v(2,:)
      slip(:,4) = v(4,:)
@if directs
      do i = 1, n
        slip(i,2) = v(2,i)*cos(v(7,i)/57.29577951308232D0)
        slip(i,3) = v(2,i)*sin(v(7,i)/57.29577951308232D0)
        where (abs(slip(i,2:3)) .lt. v(2,i)*1.0D-15) slip(i,2:3) = 0
      end do
@end
C     iData: step, increment, element, point, state variables, kind
      idata(4) = 7
      idata(5) = 0
      idata(6) = 2
      if (n .eq. 1) then
        idata(5) = 11 + 2*nh
        rdata(8) = v(5,1)
        rdata(9) = v(6,1)
        do i = 1, nh
          rdata(12+i) = hist(i,1)
        end do
      end if
@else
      slip = v(2,:)
@end
      coef = 0
      deriv = 0
      call fric_coef(coef, deriv, n, nprops, 1, nfield, idata, rdata,
     &  cin, csl, cms, prop, slip, press, temp, fav)
@if new
      tau = coef(:,1)
@else
      tau = coef
@end
      end
C
C     One call of FRIC_COEF (ftincr in src/codegen/driven_path.h).
C     par: time increment, step, increment, whether there are
C     temperatures, state variables, directions. v: pressure, slip rate,
C     slip, temperature, components of the slip rate (2). st: of the
C     first point. out: coefficient, derivatives by slip rate, pressure,
C     temperature, slip and components (2), sum of the others.
      subroutine ftincr(n, npar, par, nv, v, ns, st, np, prop, nf,
     &  field, nout, out)
      include 'aba_param.inc'
@include fortran/ftincr_arguments.f
      character*80 cin, csl, cms
      dimension press(n), temp(n), fav(n,nf)
@if new
      dimension coef(n,2), deriv(n,20,2), slip(n,6), rdata(7+ns)
      dimension idata(6)
@else
      dimension coef(n), deriv(n,3), slip(n), rdata(3), idata(2)
@end
      cin = '@{contact}'
      csl = 'SEC'
      cms = 'MAIN'
      rdata = 0.5D0
      rdata(1) = 3*par(1)
      rdata(2) = 5*par(1)
      rdata(3) = par(1)
      idata(1) = nint(par(2))
      idata(2) = nint(par(3))
      press = v(1,:)
      temp = v(4,:)
      fav = transpose(field(1:nf,:))
      coef = 77
      deriv = 77
@if new
      idata(3) = 5
      idata(4) = 7
      idata(5) = nint(par(5))
      idata(6) = nint(par(6))
      slip = 1.0D30
      slip(:,1) = v(2,:)
      slip(:,4) = v(3,:)
@if directs
      if (idata(6) .eq. 2) slip(:,2:3) = transpose(v(5:6,:))
@end
      do i = 1, ns
        rdata(7+i) = st(i,1)
      end do
@else
      slip = v(2,:)
@end
      call fric_coef(coef, deriv, int(n), int(np), nint(par(4)),
     &  int(nf), idata, rdata, cin, csl, cms, prop, slip, press, temp,
     &  fav)
@if new
      do i = 1, ns
        st(i,1) = rdata(7+i)
      end do
      out(1,:) = coef(:,1)
      out(2,:) = deriv(:,1,1)
      out(3,:) = deriv(:,2,1)
      out(4,:) = deriv(:,3,1)
      out(5,:) = deriv(:,6,1)
      out(6,:) = deriv(:,4,1)
      out(7,:) = deriv(:,5,1)
      do k = 1, n
        out(8,k) = sum(abs(deriv(k,7:20,1)))
      end do
@else
      out(1,:) = coef
      out(2,:) = deriv(:,1)
      out(3,:) = deriv(:,2)
      out(4,:) = deriv(:,3)
      out(5:8,:) = 0
@end
      end
