C     True once the values of @{file} are in memory: the first
C     call reads them while other threads wait. Where that fails it
C     says why, and every stress is NaN.
      logical function ftload()
@if windows
      use, intrinsic :: iso_c_binding, only: c_int, c_funloc, c_funptr,
     &  c_intptr_t, c_null_ptr, c_ptr
@else
      use, intrinsic :: iso_c_binding, only: c_int, c_funloc, c_funptr
@end
      implicit none
      interface
@if windows
@if externals
        integer(c_int) function fttask(begun, given, got)
     &    bind(c, name='frictab_once')
          import :: c_int, c_intptr_t, c_ptr
          integer(c_intptr_t) begun
          type(c_ptr), value :: given, got
        end function fttask
@end
        integer(c_int) function ftonce(begun, task, given, got)
     &    bind(c, name='InitOnceExecuteOnce')
          import :: c_int, c_funptr, c_intptr_t, c_ptr
          integer(c_intptr_t), intent(inout) :: begun
          type(c_funptr), value :: task
          type(c_ptr), value :: given, got
        end function ftonce
      end interface
      integer(c_intptr_t), save :: begun = 0
      logical good
      common /ftdone/ good
      ftload = ftonce(begun, c_funloc(fttask), c_null_ptr, c_null_ptr)
     &  .ne. 0
@else
@if externals
        subroutine ftfile() bind(c, name='frictab_read_values')
        end subroutine ftfile
@end
        integer(c_int) function ftonce(begun, task)
     &    bind(c, name='pthread_once')
          import :: c_int, c_funptr
          integer(c_int), intent(inout) :: begun
          type(c_funptr), value :: task
        end function ftonce
      end interface
      integer(c_int), save :: begun = 0
      logical good
      common /ftdone/ good
      ftload = ftonce(begun, c_funloc(ftfile)) .eq. 0
@end
      if (ftload) ftload = good
      return
      end
C
@if windows
C     What Windows calls once for all threads; 1: that was done.
      integer(c_int) function fttask(begun, given, got)
     &  bind(c, name='frictab_once')
      use, intrinsic :: iso_c_binding, only: c_int, c_intptr_t, c_ptr
      implicit none
      integer(c_intptr_t) begun
      type(c_ptr), value :: given, got
@if externals
      interface
        subroutine ftfile() bind(c, name='frictab_read_values')
        end subroutine ftfile
      end interface
@end
      call ftfile()
      fttask = 1
      return
      end function fttask
C
@end
      subroutine ftfile() bind(c, name='frictab_read_values')
      use, intrinsic :: iso_c_binding, only: c_int64_t
      implicit none
@if externals
      double precision tv(@{n_values})
      common /ftvals/ tv
      logical ftcrcd
@end
      logical good, there
      common /ftdone/ good
      character(len=500) path
      integer in, failed
      integer(c_int64_t) bytes
      good = .false.
      call ftpath(path)
      inquire (file=path, exist=there, size=bytes)
      if (.not. there) then
        call ftquit('friction table: there is no '//path)
        return
      end if
      if (bytes .ne. @{n_bytes}) then
        call ftquit('friction table: @{n_bytes} bytes are'//
     &    ' expected, not what is in '//path)
        return
      end if
      open (newunit=in, file=path, access='stream', status='old',
     &  form='unformatted', action='read', iostat=failed)
      if (failed .eq. 0) read (in, iostat=failed) tv
      if (failed .ne. 0) then
        call ftquit('friction table: cannot read '//path)
        return
      end if
      close (in)
      good = ftcrcd(tv)
      if (.not. good) call ftquit('friction table: damaged, or made'//
     &  ' for another routine (CRC-32): '//path)
      return
      end
C
C     Where the file lies.
      subroutine ftpath(path)
      implicit none
      character(len=500) path
      character(len=400) dir
      integer n
      call ftplac(dir, n, .false.)
      if (n .le. 0) call get_environment_variable('FRICTAB_DIR', dir, n)
@if asks_solver
      if (n .le. 0) then
        dir = ' '
        call @{outdir}(dir, n)
      end if
@end
      path = '@{file}'
      if (n .gt. 0) path = dir(1:min(n,400))//'/@{file}'
      return
      end
C
C     Keeps the directory that frictab_directory was told, and gives it
C     back; n = 0: none.
      subroutine ftplac(dir, n, told)
      implicit none
      character(len=400) dir
      integer n
      logical told
      character(len=400), save :: kept = ' '
      if (told) kept = dir
      dir = kept
      n = len_trim(kept)
      return
      end
C
C     For programs that load this routine: where the file lies, as a
C     C string, before the first call.
      subroutine ftdir(name) bind(c, name='frictab_directory')
      use, intrinsic :: iso_c_binding, only: c_char, c_null_char
      implicit none
      character(kind=c_char), intent(in) :: name(*)
      character(len=400) dir
      integer i, n
      dir = ' '
      do i = 1, 400
        if (name(i) .eq. c_null_char) exit
        dir(i:i) = name(i)
      end do
      call ftplac(dir, n, .true.)
      return
      end
C
C     Whether the CRC-32 (zip, zlib) of the values is the right one.
      logical function ftcrcd(tv)
      use, intrinsic :: iso_c_binding, only: c_int8_t, c_int32_t,
     &  c_int64_t
      implicit none
      double precision, intent(in) :: tv(@{n_values})
      integer(c_int32_t) crc, table(0:255), j
      integer(c_int8_t) bytes(8)
      integer i, l
      do i = 0, 255
        crc = int(i, c_int32_t)
        do l = 1, 8
          j = ishft(crc, -1)
          if (btest(crc, 0)) j = ieor(j, -306674912_c_int32_t)
          crc = j
        end do
        table(i) = crc
      end do
      crc = not(0_c_int32_t)
      do i = 1, @{n_values}
        bytes = transfer(tv(i), bytes)
        do l = 1, 8
          j = ieor(crc, int(bytes(l), c_int32_t))
          crc = ieor(ishft(crc, -8), table(iand(j, 255_c_int32_t)))
        end do
      end do
      ftcrcd = iand(int(not(crc), c_int64_t), 4294967295_c_int64_t)
     &  .eq. @{crc32}_c_int64_t
      return
      end
C
