C     tau_R in MPa of the state x in canonical units:
@for line in arguments
C     @{line.text}
@end
      @{pure}double precision function fttau(x)
      implicit none
      double precision@{in} x(@{n_x})
      double precision val
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
@for name in helpers
      double precision @{name.text}
@end
@end
@for line in temporaries
@{line.text}
@end
@for constant in constants
      double precision c@{constant.index}
C     @{constant.comment}
      parameter (c@{constant.index} = @{constant.value})
@end
@if externals
      logical ftnan
@end
      integer i
      do i = 1, @{n_x}
        if (ftnan(x(i))) then
          fttau = x(i)
          return
        end if
      end do
@for axis in axes
      u(@{axis.number}) = @{axis.coordinate}
@end
@if interpolates
      val = ftintp(u)
@else
      val = @{only_value}
@end
@if log_value
      val = exp(val)
@end
@for side in extending
      if (x(@{side.index}) @{side.relation} @{side.limit})
     &  val = ftpiec(x)
@end
@for line in statements
@{line.text}
@end
      fttau = @{result}
      return
      end
C
@if gradient
@{gradient_text}
@end
@if has_piece
@{piece}
@end
@if has_axes
C     True where x lies outside the range of an axis.
      @{pure}logical function ftout(x)
      implicit none
      double precision@{in} x(@{n_x})
      ftout = .false.
@for axis in ends
      if (x(@{axis.index}) .lt. @{axis.low} .or.
     &  x(@{axis.index}) .gt. @{axis.high}) ftout = .true.
@end
      return
      end
C
@end
@if interpolates
@if cubic
C     Cubic spline, the twin of frictab_cubic.h: same cells, same
C     polynomials, same order of operations. The numbers below are
C     never changed: safe in threads and parallel domains.
@else
C     Multilinear interpolation, the twin of frictab_kernel.h: same
C     nodes, same cells, same order of operations. The numbers below
C     are never changed: safe in threads and parallel domains.
@end
@if gradient
      @{pure}double precision function ftintp(u)
      implicit none
      double precision@{in} u(@{n_axes})
      double precision du(@{n_axes})
      call ftintg(u, ftintp, du, .false.)
      return
      end
C
C     The same, and where asked for the derivatives du by u: 0 beyond
C     the ends of an axis.
      @{pure}subroutine ftintg(u, val, du, deriv)
      implicit none
      logical@{in} deriv
      double precision@{in} u(@{n_axes})
      double precision@{out} val, du(@{n_axes})
      double precision x, t
@else
      @{pure}double precision function ftintp(u)
      implicit none
      double precision@{in} u(@{n_axes})
      double precision x, t
@end
      integer i, at
@if uses_bisection
      integer high, middle
@end
@for axis in axes
@if axis.scaled
      double precision sc@{axis.number}, sh@{axis.number}
      parameter (sc@{axis.number} = @{axis.scale})
      parameter (sh@{axis.number} = @{axis.shift})
@end
@end
@for line in names
@{line.text}
@end
@if cubic
      integer l
      double precision w(4,@{n_axes})
@end
@{data}
      at = 1
@for axis in axes
C     axis @{axis.number}: cell i (from 0), weight t of its upper node
      x = u(@{axis.number})
      if (x .le. un(@{axis.node})) then
        i = 0
        t = 0.0D0
      else if (x .ge. un(@{axis.last_node})) then
        i = @{axis.last_cell}
        t = 1.0D0
      else
@if axis.one_cell
        i = 0
@end
@if axis.scaled
        i = int(x*sc@{axis.number} - sh@{axis.number})
@if axis.guided
        i = gd(i+@{axis.guide})
@end
        do while (x .ge. un(i+@{axis.next_node}))
          i = i + 1
        end do
@end
@if axis.bisected
        i = 0
        high = @{axis.cells}
        do while (high - i .gt. 1)
          middle = (i + high)/2
          if (un(middle+@{axis.node}) .le. x) then
            i = middle
          else
            high = middle
          end if
        end do
@end
        t = (x - un(i+@{axis.node}))*pc(i+@{axis.cell})
      end if
@if gradient
      k@{axis.number} = i
@if cubic
      t@{axis.number} = t
@end
@end
@if cubic
      at = at + fc(i+@{axis.cell})*@{axis.stride}
      i = 16*(i + @{axis.cell_before})
      do l = 1, 4
        w(l,@{axis.number}) = tb(i+l) + t*(tb(i+l+4)
     &    + t*(tb(i+l+8) + t*tb(i+l+12)))
      end do
@else
      at = at + i*@{axis.stride}
      w@{axis.number} = t
      v@{axis.number} = 1.0D0 - t
@end
@end
@if gradient
      if (deriv) then
@for axis in axes
        g@{axis.number} = pc(k@{axis.number}+@{axis.cell})
        if (u(@{axis.number}) .lt. un(@{axis.node}) .or.
     &    u(@{axis.number}) .gt. un(@{axis.last_node}))
     &    g@{axis.number} = 0.0D0
@if cubic
        i = 16*(k@{axis.number} + @{axis.cell_before})
        do l = 1, 4
          sl(l,@{axis.number}) = g@{axis.number}*(tb(i+l+4)
     &      + t@{axis.number}*(2.0D0*tb(i+l+8)
     &      + t@{axis.number}*(3.0D0*tb(i+l+12))))
        end do
@end
@end
@for line in slopes
@{line.text}
@end
        return
      end if
@end
@for line in steps
@{line.text}
@end
      return
      end
C
@end
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
@if uses_min
      @{pure}double precision function ftmin(a, b)
      implicit none
      double precision@{in} a, b
@if externals
      logical ftnan
@end
      ftmin = a
      if (ftnan(a)) return
      if (ftnan(b)) then
        ftmin = b
      else if (b .lt. a) then
        ftmin = b
      end if
      return
      end
C
@end
@if uses_max
      @{pure}double precision function ftmax(a, b)
      implicit none
      double precision@{in} a, b
@if externals
      logical ftnan
@end
      ftmax = a
      if (ftnan(a)) return
      if (ftnan(b)) then
        ftmax = b
      else if (b .gt. a) then
        ftmax = b
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
      integer*8 bits
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
      integer*8 bits
      bits = ibclr(transfer(x, bits), 63)
      ftnan = bits .gt. 9218868437227405312_8
      return
      end
