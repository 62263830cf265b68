/* Preloaded into a program (LD_PRELOAD): its FAIL_AT-th call that changes a file fails with EIO, or
   kills it (FAIL_HOW=kill). Without FAIL_AT nothing changes. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
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
  if (how && strcmp(how, "kill") == 0) kill(getpid(), SIGKILL);
  errno = EIO;
  return 1;
}

/* Not a pipe, a terminal, ... */
static int is_file(int file) {
  struct stat status;
  return fstat(file, &status) == 0 && S_ISREG(status.st_mode);
}

#define REAL(type, name, ...) ((type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, name))

ssize_t write(int file, const void *bytes, size_t size) {
  if (is_file(file) && fails()) return -1;
  return REAL(ssize_t, "write", int, const void *, size_t)(file, bytes, size);
}
ssize_t writev(int file, const struct iovec *parts, int count) {
  if (is_file(file) && fails()) return -1;
  return REAL(ssize_t, "writev", int, const struct iovec *, int)(file, parts, count);
}
ssize_t pwrite(int file, const void *bytes, size_t size, off_t at) {
  if (fails()) return -1;
  return REAL(ssize_t, "pwrite", int, const void *, size_t, off_t)(file, bytes, size, at);
}
ssize_t pwrite64(int file, const void *bytes, size_t size, off64_t at) {
  if (fails()) return -1;
  return REAL(ssize_t, "pwrite64", int, const void *, size_t, off64_t)(file, bytes, size, at);
}
int rename(const char *from, const char *to) {
  return fails() ? -1 : REAL(int, "rename", const char *, const char *)(from, to);
}
int link(const char *from, const char *to) {
  return fails() ? -1 : REAL(int, "link", const char *, const char *)(from, to);
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
