/* Preloaded into a program (LD_PRELOAD): its FAIL_AT-th call that changes a file fails with EIO, by
   FAIL_HOW=ENOSPC with that, writes half of what it should (short), or kills it (kill). It then
   makes a file FAIL_SEEN, where that is set. Without FAIL_AT nothing changes. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

static atomic_long calls;

static int fails(void) {
  const char *at = getenv("FAIL_AT"), *how = getenv("FAIL_HOW");
  if (!at || atomic_fetch_add(&calls, 1) + 1 != atol(at)) return 0;
  const char *seen = getenv("FAIL_SEEN");
  if (seen) close(creat(seen, 0666));
  if (how && strcmp(how, "kill") == 0) kill(getpid(), SIGKILL);
  errno = how && strcmp(how, "ENOSPC") == 0 ? ENOSPC : EIO;
  return 1;
}

static int cuts_short(void) {
  const char *how = getenv("FAIL_HOW");
  return how && strcmp(how, "short") == 0;
}

/* Not a pipe, a terminal, ... */
static int is_file(int file) {
  struct stat status;
  return fstat(file, &status) == 0 && S_ISREG(status.st_mode);
}

#define REAL(type, name, ...) ((type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, name))

ssize_t write(int file, const void *bytes, size_t size) {
  if (is_file(file) && fails()) {
    if (!cuts_short() || size < 2) return -1;
    size /= 2;
  }
  return REAL(ssize_t, "write", int, const void *, size_t)(file, bytes, size);
}
ssize_t writev(int file, const struct iovec *parts, int count) {
  if (is_file(file) && fails()) return -1;
  return REAL(ssize_t, "writev", int, const struct iovec *, int)(file, parts, count);
}
ssize_t pwrite(int file, const void *bytes, size_t size, off_t at) {
  if (fails()) {
    if (!cuts_short() || size < 2) return -1;
    size /= 2;
  }
  return REAL(ssize_t, "pwrite", int, const void *, size_t, off_t)(file, bytes, size, at);
}
ssize_t pwrite64(int file, const void *bytes, size_t size, off64_t at) {
  if (fails()) {
    if (!cuts_short() || size < 2) return -1;
    size /= 2;
  }
  return REAL(ssize_t, "pwrite64", int, const void *, size_t, off64_t)(file, bytes, size, at);
}
int rename(const char *from, const char *to) {
  return fails() ? -1 : REAL(int, "rename", const char *, const char *)(from, to);
}
int link(const char *from, const char *to) {
  return fails() ? -1 : REAL(int, "link", const char *, const char *)(from, to);
}
int ftruncate(int file, off_t size) {
  return fails() ? -1 : REAL(int, "ftruncate", int, off_t)(file, size);
}
int ftruncate64(int file, off64_t size) {
  return fails() ? -1 : REAL(int, "ftruncate64", int, off64_t)(file, size);
}
/* NO_LOCKS: as some network file systems. */
int flock(int file, int what) {
  if (!getenv("NO_LOCKS")) return REAL(int, "flock", int, int)(file, what);
  errno = ENOLCK;
  return -1;
}
int fsync(int file) {
  return fails() ? -1 : REAL(int, "fsync", int)(file);
}
int mkdir(const char *name, mode_t mode) {
  return fails() ? -1 : REAL(int, "mkdir", const char *, mode_t)(name, mode);
}
int remove(const char *name) {
  return fails() ? -1 : REAL(int, "remove", const char *)(name);
}
int unlinkat(int directory, const char *name, int flags) {
  return fails() ? -1 : REAL(int, "unlinkat", int, const char *, int)(directory, name, flags);
}
int unlink(const char *name) {
  return fails() ? -1 : REAL(int, "unlink", const char *)(name);
}
