@{stop}
C     tau_R in MPa of the state x in canonical units:
C     @{arguments...}
      @{pure_tau}double precision function fttau(x)
      implicit none
      double precision@{in} x(@{n_x})
      double precision @{value}
@if interpolates
      double precision u(@{n_axes})
@end
@if externals
@if interpolates
      double precision ftintp
@end
@if uses_log
      double precision ftlog
@end
@if has_piece
      double precision ftpiec
@end
      double precision @{helpers...}
@end
@{variables...}
@include fortran/named_constants.f
@if externals
      logical ftnan
@if in_file
      logical ftload
      double precision ftqnan
@end
@end
      integer(8) i
      integer(8) bits, most
      most = 0
      do i = 1, @{n_x}
        most = max(most, ibclr(transfer(x(i), bits), 63))
      end do
      if (most .gt. 9218868437227405312_8) then
        do i = 1, @{n_x}
          fttau = x(i)
          if (ftnan(x(i))) return
        end do
      end if
@if in_file
      if (.not. ftload()) then
        fttau = ftqnan()
        return
      end if
@end
@for axis in axes
      u(@{axis.number}) = @{axis.coordinate}
@end
@if interpolates
      @{value} = ftintp(u)
@else
      @{value} = @{only_value}
@end
@if log_value
      @{value} = exp(@{value})
@end
@for side in extending
      if (x(@{side.index}) @{side.relation} @{side.limit})
     &  @{value} = ftpiec(x)
@end
C     the formula at the head; its value is @{value}
@{states...}
@{statements...}
      return
      end
C
@{gradient_text}
@{piece}
@if has_ends
C     True where x lies outside the range of an axis, or an input that
C     is held outside what was tested.
      @{pure}logical function ftout(x)
      implicit none
      double precision@{in} x(@{n_x})
      ftout = .false.
@for axis in ends
      if (x(@{axis.index}) .lt. @{axis.low} .or.
     &  x(@{axis.index}) .gt. @{axis.high}) ftout = .true.
@end
@if summarises
      if (ftout) call ftseen(x)
@end
      return
      end
C
@{summary}
@end
@{interpolation}
@{values_file}
@if uses_log
C     Zero and negative values lie below every logarithmic axis.
      @{pure}double precision function ftlog(x)
      implicit none
      double precision@{in} x
      ftlog = -huge(x)
      if (x .gt. 0.0D0) ftlog = log(x)
      return
      end
C
@end
@for extreme in extremes
      @{pure}double precision function @{extreme.name}(a, b)
      implicit none
      double precision@{in} a, b
@if externals
      logical ftnan
@end
      integer(8) bits
      @{extreme.name} = a
C     By the bits of both at once, which spares the calls.
      if (max(ibclr(transfer(a, bits), 63),
     &  ibclr(transfer(b, bits), 63)) .gt. 9218868437227405312_8) then
        if (.not. ftnan(a)) @{extreme.name} = b
      else if (b @{extreme.relation} a) then
        @{extreme.name} = b
      end if
      return
      end
C
@end
@if uses_where
C     p where a <= b, else q
      @{pure}double precision function ftwhle(a, b, p, q)
      implicit none
      double precision@{in} a, b, p, q
@if externals
      logical ftnan
@end
      if (ftnan(a)) then
        ftwhle = a
      else if (ftnan(b)) then
        ftwhle = b
      else if (a .le. b) then
        ftwhle = p
      else
        ftwhle = q
      end if
      return
      end
C
@end
@if uses_unknown
C     A quiet NaN, without arithmetic that could trap.
      @{pure}double precision function ftqnan()
      implicit none
      integer(8) bits
      parameter (bits = 9221120237041090560_8)
      ftqnan = transfer(bits, ftqnan)
      return
      end
C
@end
C     True for NaN: by its bits, so that neither traps nor options
C     like fast arithmetic can interfere.
      @{pure}logical function ftnan(x)
      implicit none
      double precision@{in} x
      integer(8) bits
      bits = ibclr(transfer(x, bits), 63)
      ftnan = bits .gt. 9218868437227405312_8
      return
      end
