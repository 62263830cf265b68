@if windows
        subroutine @{stem}lock(lock) bind(c, name='AcquireSRWLockExclusive')
          import :: c_int64_t
          integer(c_int64_t) lock(8)
        end subroutine @{stem}lock
        subroutine @{stem}free(lock) bind(c, name='ReleaseSRWLockExclusive')
          import :: c_int64_t
          integer(c_int64_t) lock(8)
        end subroutine @{stem}free
@else
        integer(c_int) function @{stem}lock(lock)
     &    bind(c, name='pthread_mutex_lock')
          import :: c_int, c_int64_t
          integer(c_int64_t) lock(8)
        end function @{stem}lock
        integer(c_int) function @{stem}free(lock)
     &    bind(c, name='pthread_mutex_unlock')
          import :: c_int, c_int64_t
          integer(c_int64_t) lock(8)
        end function @{stem}free
@end
