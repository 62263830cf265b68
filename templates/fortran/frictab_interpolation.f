@if cubic
C     Cubic spline, the twin of frictab_cubic.h: same cells, same
C     polynomials, same order of operations. The numbers below are
C     never changed: safe in threads and parallel domains.
@else
C     Multilinear interpolation, the twin of frictab_kernel.h: same
C     nodes, same cells, same order of operations. The numbers below
C     are never changed: safe in threads and parallel domains.
@end
@if wrapped
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
@end
@if slopes_asked
@if wrapped
      @{pure}subroutine ftintg(u, val, du, deriv)
      implicit none
      logical@{in} deriv
@else
      @{pure}subroutine ftintg(u, val, du)
      implicit none
@end
      double precision@{in} u(@{n_axes})
      double precision@{out} val, du(@{n_axes})
      double precision x, t
@else
      @{pure}double precision function ftintp(u)
      implicit none
      double precision@{in} u(@{n_axes})
      double precision x, t
@end
C     8 bytes, as addresses have: no place is converted first.
      integer(8) i, at
@if uses_bisection
      integer(8) high, middle
@end
@for axis in axes
@if axis.scaled
      double precision sc@{axis.number}, sh@{axis.number}
      parameter (sc@{axis.number} = @{axis.scale})
      parameter (sh@{axis.number} = @{axis.shift})
@end
@end
@{names...}
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
        i = int(x*sc@{axis.number} - sh@{axis.number}, 8)
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
@if slopes_asked
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
@if slopes_asked
@if wrapped
      if (deriv) then
@end
@for axis in axes
      g@{axis.number} = pc(k@{axis.number}+@{axis.cell})
      if (u(@{axis.number}) .lt. un(@{axis.node}) .or.
     &  u(@{axis.number}) .gt. un(@{axis.last_node})) g@{axis.number} = 0.0D0
@if cubic
      i = 16*(k@{axis.number} + @{axis.cell_before})
      do l = 1, 4
        sl(l,@{axis.number}) = g@{axis.number}*(tb(i+l+4)
     &    + t@{axis.number}*(2.0D0*tb(i+l+8)
     &    + t@{axis.number}*(3.0D0*tb(i+l+12))))
      end do
@end
@end
@{slopes...}
@if wrapped
        return
      end if
@end
@end
@{steps...}
      return
      end
C
