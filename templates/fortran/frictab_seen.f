C     Counts a state that is outside the range of the law, and keeps the
C     one that is furthest beyond an end, in lengths of its range. Says
C     so instead with `say`: when the program ends.
      subroutine ftkept(x, say)
      use, intrinsic :: iso_c_binding, only: c_int64_t
      implicit none
      double precision x(@{n_x}), far
      logical say
      integer(c_int64_t), save :: count = 0
      integer, save :: which = 0
      double precision, save :: most = 0.0D0, value = 0.0D0
      if (.not. say) then
        count = count + 1
@for axis in ends
@if axis.log
        far = huge(far)
        if (x(@{axis.index}) .gt. @{axis.high}) then
          far = log(x(@{axis.index})/@{axis.high})
     &      /@{axis.length}
        else if (x(@{axis.index}) .gt. 0.0D0) then
          far = log(@{axis.low}/x(@{axis.index}))
     &      /@{axis.length}
        end if
@else
        far = max(x(@{axis.index}) - @{axis.high},
     &    @{axis.low} - x(@{axis.index}))
        far = far/@{axis.length}
@end
        if (far .gt. most) then
          most = far
          value = x(@{axis.index})
          which = @{axis.number}
        end if
@end
        return
      end if
      write (*, '(1x,a,i0,a)') 'frictab @{model}: ',
     &  count, ' times a contact point was outside the range'
@for axis in ends
      if (which .eq. @{axis.number}) write (*, '(1x,a,1pg0.6,a)')
     &  'of the law. Furthest: @{axis.name} = ',
     &  value@{axis.to_solver}, '@{axis.unit},'
      if (which .eq. @{axis.number}) write (*, '(1x,a)')
     &  'of a range @{axis.range}.'
@end
      flush (6)
      return
      end
C
C     Of a state that is outside. Threads take turns; the first one sees
C     to it that the end of the program is told.
      subroutine ftseen(x)
      use, intrinsic :: iso_c_binding
      implicit none
      double precision x(@{n_x})
      interface
        subroutine ftlast() bind(c, name='')
        end subroutine ftlast
        integer(c_int) function ftexit(task) bind(c, name='atexit')
          import :: c_int, c_funptr
          type(c_funptr), value :: task
        end function ftexit
@{locks}
      end interface
C     Zeros are a lock that nobody holds.
      integer(c_int64_t), save :: lock(8) = 0
      logical, save :: told = .false.
      integer(c_int) done
@if windows
      call ftlock(lock)
@else
      done = ftlock(lock)
@end
      if (.not. told) then
        done = ftexit(c_funloc(ftlast))
        told = .true.
      end if
      call ftkept(x, .false.)
@if windows
      call ftfree(lock)
@else
      done = ftfree(lock)
@end
      return
      end
C
      subroutine ftlast() bind(c, name='')
      implicit none
      double precision none(@{n_x})
      none = 0.0D0
      call ftkept(none, .true.)
      return
      end
C
