/* Faults on order, for the tests of tests/reliability: preloaded into riesel, it counts the calls that
 * change files, and at one of them kills the process, holds it or lets the call fail.
 *
 *   RIESEL_FAULT=CALL:N:WHAT    at the N-th call (from 1) of CALL: open, write, pwrite, ftruncate,
 *                               fsync, link, rename, unlink, mkdir, close, or any for all of these
 *                               together
 *       WHAT = kill             SIGKILL before the call; in a write after a part of the bytes
 *              killed_after     SIGKILL when the call is done
 *              held             ten minutes pass before the call, whatever signals come
 *              a number         the call fails with this errno; in a write after a part of the bytes,
 *                               but not with EINTR, of calls that have done nothing
 *              short            of a write: only a part is written, as the call tells
 *              a number and +   this call and all further ones of its kind fail with this errno
 *   RIESEL_FAULT_LOG=FILE       the name of each call is appended before it is made: to count them
 *
 * Only calls for files below the current directory count: of descriptors that were opened for
 * writing (or are directories that are synchronised), of names that do not begin with a slash. The
 * tests give the program relative names.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { most_descriptors = 1024 };
static bool ours[most_descriptors];

static void* real(const char* name) {
  void* found = dlsym(RTLD_NEXT, name);
  if (found == NULL) abort();
  return found;
}

typedef int (*OpenCall)(const char*, int, ...);
typedef ssize_t (*WriteCall)(int, const void*, size_t);
typedef ssize_t (*WriteAtCall)(int, const void*, size_t, off_t);
typedef int (*ResizeCall)(int, off_t);
typedef int (*DescriptorCall)(int);
typedef int (*NamesCall)(const char*, const char*);
typedef int (*NameCall)(const char*);
typedef int (*MakeCall)(const char*, mode_t);

static void log_call(const char* call) {
  const char* file = getenv("RIESEL_FAULT_LOG");
  if (file == NULL) return;
  const int log = ((OpenCall)real("open"))(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  char line[32];
  const int size = snprintf(line, sizeof line, "%s\n", call);
  if (((WriteCall)real("write"))(log, line, (size_t)size) != size) abort();
  ((DescriptorCall)real("close"))(log);
}

struct Fault {
  bool now, kills, kills_after, cuts_short, holds;
  int error;
};

/* What is to happen to this call. */
static struct Fault fault_at(const char* call) {
  static int count = 0;
  log_call(call);
  struct Fault fault = {0};
  const char* order = getenv("RIESEL_FAULT");
  if (order == NULL) return fault;
  char kind[16] = "", what[32] = "";
  int when = 0;
  if (sscanf(order, "%15[^:]:%d:%31s", kind, &when, what) != 3) abort();
  if (strcmp(kind, "any") != 0 && strcmp(kind, call) != 0) return fault;
  ++count;
  const bool lasts = what[strlen(what) - 1] == '+';
  fault.now = count == when || (lasts && count > when);
  fault.kills = strcmp(what, "kill") == 0;
  fault.kills_after = strcmp(what, "killed_after") == 0;
  fault.cuts_short = strcmp(what, "short") == 0;
  fault.holds = strcmp(what, "held") == 0;
  fault.error = atoi(what);
  return fault;
}

static void die(void) {
  kill(getpid(), SIGKILL);
  pause();
}

/* A signal that is only remembered does not cut it short. */
static void hold(void) {
  struct timespec left = {.tv_sec = 600};
  while (nanosleep(&left, &left) != 0 && errno == EINTR) continue;
}

/* Before the call: whether it shall fail. */
static bool fails(const struct Fault* fault) {
  if (!fault->now || fault->kills_after || fault->cuts_short) return false;
  if (fault->kills) die();
  if (fault->holds) {
    hold();
    return false;
  }
  errno = fault->error;
  return true;
}

static void after(const struct Fault* fault) {
  if (fault->now && fault->kills_after) die();
}

/* Of the bytes of a write that is killed or fails: whether a part has been written before. */
static bool leaves_half(const struct Fault* fault) {
  return fault->now && !fault->kills_after && !fault->cuts_short && !fault->holds
         && fault->error != EINTR;
}

static size_t allowed(const struct Fault* fault, size_t size) {
  return fault->now && fault->cuts_short && size > 1 ? size / 2 : size;
}

static bool is_ours(int descriptor) {
  return descriptor >= 0 && descriptor < most_descriptors && ours[descriptor];
}

static int open_any(const char* name, int flags, mode_t mode, const char* as) {
  const bool changes = (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0 || (flags & O_DIRECTORY) != 0;
  const bool counts = name[0] != '/' && changes;
  struct Fault fault = {0};
  if (counts) fault = fault_at("open");
  if (counts && fails(&fault)) return -1;
  const int descriptor = ((OpenCall)real(as))(name, flags, mode);
  if (descriptor >= 0 && descriptor < most_descriptors) ours[descriptor] = counts;
  after(&fault);
  return descriptor;
}

static mode_t mode_of(int flags, va_list* rest) {
  return (flags & O_CREAT) != 0 ? va_arg(*rest, mode_t) : 0;
}

int open(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, &rest);
  va_end(rest);
  return open_any(name, flags, mode, "open");
}

int open64(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, &rest);
  va_end(rest);
  return open_any(name, flags, mode, "open64");
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
  const WriteCall call = (WriteCall)real("write");
  if (!is_ours(descriptor)) return call(descriptor, bytes, size);
  const struct Fault fault = fault_at("write");
  if (leaves_half(&fault) && size > 1) {
    const ssize_t part = call(descriptor, bytes, size / 2);
    (void)part;
  }
  if (fails(&fault)) return -1;
  const ssize_t written = call(descriptor, bytes, allowed(&fault, size));
  after(&fault);
  return written;
}

/* Within a sector of a disk there is no half: the head of a trajectory relies on it. */
ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  enum { sector = 512 };
  const WriteAtCall call = (WriteAtCall)real("pwrite");
  if (!is_ours(descriptor)) return call(descriptor, bytes, size, offset);
  const struct Fault fault = fault_at("pwrite");
  const bool is_within_sector = offset % sector + (off_t)size <= sector;
  if (leaves_half(&fault) && !is_within_sector) {
    const ssize_t part = call(descriptor, bytes, size / 2, offset);
    (void)part;
  }
  if (fails(&fault)) return -1;
  const ssize_t written = call(descriptor, bytes, allowed(&fault, size), offset);
  after(&fault);
  return written;
}

int ftruncate(int descriptor, off_t size) {
  const ResizeCall call = (ResizeCall)real("ftruncate");
  if (!is_ours(descriptor)) return call(descriptor, size);
  const struct Fault fault = fault_at("ftruncate");
  if (fails(&fault)) return -1;
  const int status = call(descriptor, size);
  after(&fault);
  return status;
}

static int with_descriptor(int descriptor, const char* name) {
  const DescriptorCall call = (DescriptorCall)real(name);
  if (!is_ours(descriptor)) return call(descriptor);
  const struct Fault fault = fault_at(name);
  if (fails(&fault)) return -1;
  const int status = call(descriptor);
  after(&fault);
  return status;
}

int fsync(int descriptor) { return with_descriptor(descriptor, "fsync"); }

int close(int descriptor) {
  const int status = with_descriptor(descriptor, "close");
  /* Linux has closed it even if it says that it failed. */
  if (status < 0 && is_ours(descriptor)) {
    const int error = errno;
    ((DescriptorCall)real("close"))(descriptor);
    errno = error;
  }
  if (descriptor >= 0 && descriptor < most_descriptors) ours[descriptor] = false;
  return status;
}

static int with_names(const char* from, const char* to, const char* name) {
  const NamesCall call = (NamesCall)real(name);
  if (from[0] == '/') return call(from, to);
  const struct Fault fault = fault_at(name);
  if (fails(&fault)) return -1;
  const int status = call(from, to);
  after(&fault);
  return status;
}

int rename(const char* from, const char* to) { return with_names(from, to, "rename"); }

int link(const char* from, const char* to) { return with_names(from, to, "link"); }

/* To remove what is not there changes nothing, and does not count. */
static int with_name(const char* path, const char* name) {
  const NameCall call = (NameCall)real(name);
  struct stat about;
  if (path[0] == '/' || lstat(path, &about) != 0) return call(path);
  const struct Fault fault = fault_at("unlink");
  if (fails(&fault)) return -1;
  const int status = call(path);
  after(&fault);
  return status;
}

int unlink(const char* path) { return with_name(path, "unlink"); }

/* What std::filesystem calls. */
int remove(const char* path) { return with_name(path, "remove"); }

int mkdir(const char* path, mode_t mode) {
  const MakeCall call = (MakeCall)real("mkdir");
  if (path[0] == '/') return call(path, mode);
  const struct Fault fault = fault_at("mkdir");
  if (fails(&fault)) return -1;
  const int status = call(path, mode);
  after(&fault);
  return status;
}
