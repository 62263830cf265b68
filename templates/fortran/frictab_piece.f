C     The law's own @{quantity} of the state x, by its formula; held at
C     the ends of the range on sides that clamp.
      @{pure}double precision function ftpiec(x)
      implicit none
@if gradient
      double precision@{in} x(@{n_x})
      double precision dv(@{n_x})
      call ftpieg(x, ftpiec, dv, .false.)
      return
      end
C
C     The same, and where asked for its derivatives dv by x: 0 where x
C     is held at an end.
      @{pure}subroutine ftpieg(x, @{value}, dv, deriv)
      implicit none
      logical@{in} deriv
      double precision@{in} x(@{n_x})
      double precision@{out} @{value}, dv(@{n_x})
@else
      double precision@{in} x(@{n_x})
@end
@{variables...}
@if externals
      double precision @{helpers...}
@end
@include fortran/named_constants.f
@if has_layer
C     @{units} units of tanh, @{outputs} outputs: unit i belongs to output
C     1 + mod(i-1, @{outputs}).
      integer i, j, nunit, nout
      parameter (nunit = @{units}, nout = @{outputs})
      double precision a, b, c, z, y, p, q
      double precision unit(nunit), net(nout)
@if gradient
      double precision adj(nout)
@for feature in features
      double precision b@{feature.index}
@end
@end
@{data}
@end
@{states...}
@if has_layer
@{before...}
      do i = 1, nunit
        a = 0.0D0
@for feature in features
        a = a + wt@{feature.index}(i)*@{feature.name}
@end
        a = a + bias(i)
        b = a
        if (a .lt. -19.1D0) b = -19.1D0
        c = b
        if (b .gt. 19.1D0) c = 19.1D0
        unit(i) = c
      end do
C     tanh to 5e-15 of its value, without a branch: Lambert's
C     continued fraction of tanh(x/4), 8 terms, and the double-angle
C     formula twice. Beyond 19.1 tanh is 1 to 5e-17.
      do i = 1, nunit
        z = 0.25D0*unit(i)
        y = z*z
        p = z*(2027025.0D0 + y*(270270.0D0 + y*(6930.0D0
     &    + y*36.0D0)))
        q = 2027025.0D0 + y*(945945.0D0 + y*(51975.0D0
     &    + y*(630.0D0 + y)))
        a = (p + p)*q
        b = p*p + q*q
        unit(i) = (a + a)*b/(a*a + b*b)
      end do
      do j = 1, nout
        net(j) = offs(j)
      end do
      do i = 0, nunit - 1, nout
        do j = 1, nout
          net(j) = net(j) + gain(i+j)*unit(i+j)
        end do
      end do
@end
@{statements...}
@if gradient
      if (.not. deriv) return
@{adjoints...}
@if has_layer
C     Slopes of the units, times what the result changes by them.
@for output in by_outputs
      adj(@{output.index}) = @{output.name}
@end
      do i = 0, nunit - 1, nout
        do j = 1, nout
          a = unit(i+j)
          unit(i+j) = adj(j)*gain(i+j)*(1.0D0 - a*a)
        end do
      end do
@for feature in features
      b@{feature.index} = 0.0D0
@end
      do i = 1, nunit
@for feature in features
        b@{feature.index} = b@{feature.index}
     &    + wt@{feature.index}(i)*unit(i)
@end
      end do
@end
@{slopes...}
@for side in stopped
      if (x(@{side.index}) @{side.relation} @{side.limit})
     &  dv(@{side.index}) = 0.0D0
@end
@end
      return
      end
C
