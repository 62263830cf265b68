C     Calls FRIC_COEF as Abaqus/Standard does (see ftdriv in
C     src/codegen/driver.h). States: 1 pressure, 2 slip rate,
@if new
C     3 temperature, 4 slip, 5 work, 6 peak pressure. State variables
C     are there where a call holds one point.
@else
C     3 temperature.
@end
      subroutine ftdriv(n, ns, v, np, prop, nf, field, nh, hist, tau)
      include 'aba_param.inc'
      integer*4 n, ns, np, nf, nh
      real*8 v(ns,n), prop(np), field(nf,n), hist(nh,n), tau(n)
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
