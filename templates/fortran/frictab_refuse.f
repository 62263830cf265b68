C     True where x lies beyond a side with outside = error: then the
C     analysis ends after a message that names the state. By more
C     than a millionth of the end's value: single precision misses an
C     end by rounding.
      logical function ftstop(x)
      implicit none
      double precision x(@{n_x}), bad
      character*60 name
      character*140 text
      integer i
      logical ftnan
      external ftnan
      ftstop = .false.
      bad = 0.0D0
      name = ' '
      do i = 1, @{n_x}
        if (ftnan(x(i))) return
      end do
@for side in refusing
      if (x(@{side.index}) @{side.relation} @{side.limit}) then
        ftstop = .true.
        bad = x(@{side.index})@{side.to_solver}
        name =
     &  '@{side.name}'
      end if
@end
      if (.not. ftstop) return
      write (text, '(a,1p,e14.6,a,a)') 'friction table: state', bad,
     &  ' is outside the range: ', name
      call ftquit(text)
      return
      end
C
