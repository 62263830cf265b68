C     VUFIELD for Abaqus/Explicit: what friction did at each node, as
C     field variables that contour plots show (FV):
C       1 the friction coefficient,
C       2 the frictional shear stress (@{stress}),
C       3 how often the node was outside the range of the law.
C     In the step of the input deck:
C       *Field, user, number=3
C        <nodes of the contact surfaces>
C       *Output, field
C       *Element Output
C        FV
C     No material may depend on field variables 1 to 3.
C
C     1 and 2 are 0 at nodes that were not in contact in this increment
C     or the one before. Of several contacts of a node the one with the
C     largest stress is shown. A restarted analysis counts 3 anew.
C
C     Argument list:
C     @{source...}
C
      subroutine vufield(field, nBlock, nField, kField, nComp,
     1 kStep, jFlags, jNodeUid, time,
     2 coords, u, v, a)
      include 'vaba_param.inc'
C     jFlags: increment, pass.
      dimension field(nBlock,nComp,nField), jFlags(2), jNodeUid(nBlock),
     1 time(4), coords(3,nBlock), u(8,nBlock), v(8,nBlock), a(8,nBlock)
      double precision seen(3)
      do k = 1, nBlock
        call fvnode(.false., jNodeUid(k), kStep, jFlags(1), seen)
        do i = 1, nField
C         All of them at once, or one alone.
          number = i
          if (nField .eq. 1) number = kField
          if (number .lt. 1 .or. number .gt. 3) cycle
          do j = 1, nComp
            field(k,j,i) = real(seen(number), kind(field))
          end do
        end do
      end do
      return
      end
C
C     One contact point in contact, called by the friction routine.
      subroutine fvkeep(node, kstep, kinc, stress, mu, outside)
      implicit none
      integer node, kstep, kinc
      double precision stress, mu, outside, seen(3)
      seen(1) = mu
      seen(2) = stress
      seen(3) = outside
      call fvnode(.true., node, kstep, kinc, seen)
      return
      end
C
C     Keeps what was seen at a node, or gives it. All nodes that
C     friction has met, by their numbers in the deck: a
C     table with open addressing, at most half full. Threads take turns.
C     In a domain-parallel analysis each process knows its own nodes.
      subroutine fvnode(keep, node, kstep, kinc, seen)
      use, intrinsic :: iso_c_binding, only: c_int, c_int64_t
      implicit none
      logical keep
      integer node, kstep, kinc
      double precision seen(3)
      interface
@{locks}
      end interface
C     Zeros are a lock that nobody holds. Node 0 is a free place.
      integer(c_int64_t), save :: lock(8) = 0
      integer, save :: filled = 0
      integer, allocatable, save :: nodes(:), when(:,:)
      double precision, allocatable, save :: values(:,:)
      integer at
@if windows
      call fvlock(lock)
@else
      integer(c_int) done
      done = fvlock(lock)
@end
      if (.not. allocated(nodes)) call enlarge(1024)
      if (keep .and. 2*(filled + 1) .gt. size(nodes))
     &  call enlarge(2*size(nodes))
      at = place(node)
      if (keep) then
        if (nodes(at) .eq. 0) then
          nodes(at) = node
          filled = filled + 1
          values(:,at) = 0.0D0
          when(:,at) = -1
        end if
        if (when(1,at) .ne. kstep .or. when(2,at) .ne. kinc .or.
     &    seen(2) .ge. values(2,at)) values(1:2,at) = seen(1:2)
        values(3,at) = values(3,at) + seen(3)
        when(1,at) = kstep
        when(2,at) = kinc
      else
        seen = 0.0D0
        if (nodes(at) .ne. 0) then
          seen(3) = values(3,at)
          if (recent(when(1,at), when(2,at))) seen(1:2) = values(1:2,at)
        end if
      end if
@if windows
      call fvfree(lock)
@else
      done = fvfree(lock)
@end
      return
C
      contains
C
C     Increments count from 1 in every step.
      logical function recent(step, inc)
      integer step, inc
      recent = (step .eq. kstep .and. kinc - inc .le. 1) .or.
     &  (step .eq. kstep - 1 .and. kinc .le. 1)
      end function
C
C     Where a node is, or would be.
      integer function place(number)
      integer number
      place = iand(ieor(number, ishft(number, -10)), size(nodes) - 1)
      do while (nodes(place+1) .ne. number .and. nodes(place+1) .ne. 0)
        place = iand(place + 1, size(nodes) - 1)
      end do
      place = place + 1
      end function
C
      subroutine enlarge(length)
      integer length, i, to
      integer, allocatable :: nodes0(:), when0(:,:)
      double precision, allocatable :: values0(:,:)
      call move_alloc(nodes, nodes0)
      call move_alloc(when, when0)
      call move_alloc(values, values0)
      allocate (nodes(length), when(2,length), values(3,length))
      nodes = 0
      if (.not. allocated(nodes0)) return
      do i = 1, size(nodes0)
        if (nodes0(i) .eq. 0) cycle
        to = place(nodes0(i))
        nodes(to) = nodes0(i)
        when(:,to) = when0(:,i)
        values(:,to) = values0(:,i)
      end do
      end subroutine
      end
