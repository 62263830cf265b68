C     tau as fttau gives it, and its derivatives dtau by x: MPa per
C     canonical unit. 0 by an axis at whose end the table stops, NaN
C     where x holds one@{refused_text}.
      @{pure_tau}subroutine ftgrad(x, tau, dtau)
      implicit none
      double precision@{in} x(@{n_x})
      double precision@{out} tau, dtau(@{n_x})
      double precision @{value}
@if has_by
      double precision by(@{n_x})
@end
@if interpolates
      double precision u(@{n_axes}), du(@{n_axes})
@end
@if externals
@if uses_log
      double precision ftlog
@end
@if makes_nan
      double precision ftqnan
@end
      double precision @{helpers...}
      logical ftnan
@if in_file
      logical ftload
@end
@end
@{variables...}
@include fortran/named_constants.f
@if extends
      logical beyond
@end
      integer i, j
      integer(8) bits, most
      most = 0
      do i = 1, @{n_x}
        most = max(most, ibclr(transfer(x(i), bits), 63))
      end do
      if (most .gt. 9218868437227405312_8) then
        do i = 1, @{n_x}
          if (ftnan(x(i))) then
            tau = x(i)
            do j = 1, @{n_x}
              dtau(j) = x(i)
            end do
            return
          end if
        end do
      end if
@if in_file
      if (.not. ftload()) then
        tau = ftqnan()
        do j = 1, @{n_x}
          dtau(j) = tau
        end do
        return
      end if
@end
C     @{value} and its derivatives by x
@if has_by
      do i = 1, @{n_x}
        by(i) = 0.0D0
      end do
@end
@if interpolates
@for axis in axes
      u(@{axis.number}) = @{axis.coordinate}
@end
      call ftintg(u, @{value}, du@{wish})
@if log_value
      @{value} = exp(@{value})
@end
@for axis in axes
@if axis.log
      if (abs(du(@{axis.number})) .gt. 0.0D0)
     &  by(@{axis.input}) = du(@{axis.number})/x(@{axis.input})
@else
      by(@{axis.input}) = du(@{axis.number})
@end
@if log_value
      by(@{axis.input}) = @{value}*by(@{axis.input})
@end
@end
@if extends
      beyond = .false.
@for side in extending
      if (x(@{side.index}) @{side.relation} @{side.limit})
     &  beyond = .true.
@end
      if (beyond) call ftpieg(x, @{value}, by, .true.)
@end
@else
@if has_piece
      call ftpieg(x, @{value}, by, .true.)
@else
      @{value} = @{only_value}
@if log_value
      @{value} = exp(@{value})
@end
@end
@end
C     the formula at the head and its derivatives
@{states...}
@{statements...}
@{slopes...}
@for side in refusing
      if (x(@{side.index}) @{side.relation} @{side.limit}) then
        do i = 1, @{n_x}
          dtau(i) = ftqnan()
        end do
      end if
@end
      return
      end
C