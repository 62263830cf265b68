/* Preloaded into a program (LD_PRELOAD): its FAIL_AT-th call that changes a file fails with EIO, by
   FAIL_HOW=ENOSPC with that, writes half of what it should (short), says that it has done what it
   has not (lie), or kills it (kill). It then makes a file FAIL_SEEN, where that is set. With
   FAIL_READS it is instead a call that opens, lists or reads a file of a user. Without FAIL_AT
   nothing changes. */
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

static atomic_long calls;

static int fails_as(int is_read) {
  const char *at = getenv("FAIL_AT"), *how = getenv("FAIL_HOW");
  if (!at || is_read != (getenv("FAIL_READS") != NULL)) return 0;
  if (atomic_fetch_add(&calls, 1) + 1 != atol(at)) return 0;
  const char *seen = getenv("FAIL_SEEN");
  if (seen) close(creat(seen, 0666));
  if (how && strcmp(how, "kill") == 0) kill(getpid(), SIGKILL);
  errno = how && strcmp(how, "ENOSPC") == 0 ? ENOSPC : EIO;
  return 1;
}

static int fails(void) {
  return fails_as(0);
}

static int is_how(const char *word) {
  const char *how = getenv("FAIL_HOW");
  return how && strcmp(how, word) == 0;
}

/* Of nobody's data: libraries, devices, and what the system tells. */
static int is_of_system(const char *path) {
  static const char *const places[] = {"/usr/", "/lib", "/etc/", "/proc/", "/dev/", "/sys/"};
  for (size_t i = 0; i < sizeof places / sizeof *places; ++i)
    if (strncmp(path, places[i], strlen(places[i])) == 0) return 1;
  return 0;
}

/* Not a pipe, a terminal, ... */
static int is_file(int file) {
  struct stat status;
  return fstat(file, &status) == 0 && S_ISREG(status.st_mode);
}

#define REAL(type, name, ...) ((type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, name))

ssize_t write(int file, const void *bytes, size_t size) {
  if (is_file(file) && fails()) {
    if (is_how("lie")) return (ssize_t)size;
    if (!is_how("short") || size < 2) return -1;
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
    if (is_how("lie")) return (ssize_t)size;
    if (!is_how("short") || size < 2) return -1;
    size /= 2;
  }
  return REAL(ssize_t, "pwrite", int, const void *, size_t, off_t)(file, bytes, size, at);
}
ssize_t pwrite64(int file, const void *bytes, size_t size, off64_t at) {
  if (fails()) {
    if (is_how("lie")) return (ssize_t)size;
    if (!is_how("short") || size < 2) return -1;
    size /= 2;
  }
  return REAL(ssize_t, "pwrite64", int, const void *, size_t, off64_t)(file, bytes, size, at);
}
int rename(const char *from, const char *to) {
  return fails() ? (is_how("lie") ? 0 : -1)
                 : REAL(int, "rename", const char *, const char *)(from, to);
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
ssize_t read(int file, void *bytes, size_t size) {
  if (is_file(file) && fails_as(1)) {
    if (!is_how("short")) return -1;
    size -= size / 2;
  }
  return REAL(ssize_t, "read", int, void *, size_t)(file, bytes, size);
}
ssize_t readv(int file, const struct iovec *parts, int count) {
  if (is_file(file) && fails_as(1)) return -1;
  return REAL(ssize_t, "readv", int, const struct iovec *, int)(file, parts, count);
}
ssize_t pread(int file, void *bytes, size_t size, off_t at) {
  if (fails_as(1)) {
    if (!is_how("short")) return -1;
    size -= size / 2;
  }
  return REAL(ssize_t, "pread", int, void *, size_t, off_t)(file, bytes, size, at);
}
ssize_t pread64(int file, void *bytes, size_t size, off64_t at) {
  if (fails_as(1)) {
    if (!is_how("short")) return -1;
    size -= size / 2;
  }
  return REAL(ssize_t, "pread64", int, void *, size_t, off64_t)(file, bytes, size, at);
}
int open(const char *path, int how, ...) {
  va_list more;
  va_start(more, how);
  const int mode = how & O_CREAT ? va_arg(more, int) : 0;
  va_end(more);
  if ((how & O_ACCMODE) == O_RDONLY && !is_of_system(path) && fails_as(1) &&
      !is_how("short"))
    return -1;
  return REAL(int, "open", const char *, int, ...)(path, how, mode);
}
DIR *opendir(const char *path) {
  return fails_as(1) && !is_how("short") ? NULL : REAL(DIR *, "opendir", const char *)(path);
}
