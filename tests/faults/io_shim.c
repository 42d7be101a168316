// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
//
// Preloaded into a program (LD_PRELOAD), fails or records what it does to the files of one folder.
//
//   FAULT_FOLDER   the folder, absolute and without links; nothing outside is touched
//   FAULT_COUNTER  a file of two 64-bit numbers, kept up to date: operations so far, and how many
//                  of them were made to fail
//   FAULT_AT       the operation, from 1, that fails; 0 or unset: none
//   FAULT_MODE     how: eio_once, eio_forever, enospc_once, enospc_forever; half_exit (a write gets
//                  half of its bytes, then the process ends), exit (it ends before the operation)
//   FAULT_TRACE    a file that gets every operation that succeeded, in order; see write_record
//
// Operations are write, pwrite, fsync, fdatasync, ftruncate, rename and unlink. What is written
// through mmap is not seen: SQLite does so with its -shm file only, which a crash voids anyway.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

enum { EXIT_BY_FAULT = 86, MAX_PATH = 1024 };
enum mode { NONE, ONCE, FOREVER, HALF_EXIT, EXIT };

static struct {
  const char* folder;
  size_t folder_length;
  volatile uint64_t* counter;  // operations, failures
  uint64_t at;
  enum mode mode;
  int error;
  int trace;  // descriptor, -1: none
} shim = {NULL, 0, NULL, 0, NONE, 0, -1};

// Held from the decision about an operation until it is recorded: the trace has their true order.
static pthread_mutex_t in_order = PTHREAD_MUTEX_INITIALIZER;

static ssize_t (*real_write)(int, const void*, size_t);
static ssize_t (*real_pwrite)(int, const void*, size_t, off_t);
static int (*real_fsync)(int);
static int (*real_fdatasync)(int);
static int (*real_ftruncate)(int, off_t);
static int (*real_rename)(const char*, const char*);
static int (*real_unlink)(const char*);

static void read_mode(const char* mode) {
  if (mode == NULL) return;
  shim.error = strncmp(mode, "enospc", 6) == 0 ? ENOSPC : EIO;
  if (strcmp(mode, "exit") == 0) {
    shim.mode = EXIT;
  } else if (strcmp(mode, "half_exit") == 0) {
    shim.mode = HALF_EXIT;
  } else if (strstr(mode, "_once") != NULL) {
    shim.mode = ONCE;
  } else if (strstr(mode, "_forever") != NULL) {
    shim.mode = FOREVER;
  }
}

static void map_counter(const char* path) {
  if (path == NULL) return;
  const int file = open(path, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (file < 0 || syscall(SYS_ftruncate, file, 16) != 0) abort();
  void* mapped = mmap(NULL, 16, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (mapped == MAP_FAILED) abort();
  shim.counter = mapped;
  close(file);
}

// Parts of the C library write before any constructor of ours has run.
static void find_real_functions(void) {
  *(void**)&real_write = dlsym(RTLD_NEXT, "write");
  *(void**)&real_pwrite = dlsym(RTLD_NEXT, "pwrite64");
  *(void**)&real_fsync = dlsym(RTLD_NEXT, "fsync");
  *(void**)&real_fdatasync = dlsym(RTLD_NEXT, "fdatasync");
  *(void**)&real_ftruncate = dlsym(RTLD_NEXT, "ftruncate64");
  *(void**)&real_rename = dlsym(RTLD_NEXT, "rename");
  *(void**)&real_unlink = dlsym(RTLD_NEXT, "unlink");
}

static void begin(void) {
  static pthread_once_t once = PTHREAD_ONCE_INIT;
  pthread_once(&once, find_real_functions);
}

__attribute__((constructor)) static void set_up(void) {
  begin();
  map_counter(getenv("FAULT_COUNTER"));
  read_mode(getenv("FAULT_MODE"));
  const char* at = getenv("FAULT_AT");
  if (at != NULL) shim.at = strtoull(at, NULL, 10);
  const char* trace = getenv("FAULT_TRACE");
  if (trace != NULL) shim.trace = open(trace, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  shim.folder_length = 0;
  shim.folder = getenv("FAULT_FOLDER");  // last: from here on operations count
  if (shim.folder != NULL) shim.folder_length = strlen(shim.folder);
}

static int is_below_folder(const char* path) {
  return shim.folder_length > 0 && strncmp(path, shim.folder, shim.folder_length) == 0 &&
         (path[shim.folder_length] == '/' || path[shim.folder_length] == '\0');
}

// The path of a descriptor, in a buffer of MAX_PATH; 0 if it is not below the folder.
static int path_of(int file, char* path) {
  if (shim.folder == NULL) return 0;
  char link[64];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const int error = errno;
  const ssize_t length = readlink(link, path, MAX_PATH - 1);
  errno = error;
  if (length <= 0) return 0;
  path[length] = '\0';
  return strstr(path, " (deleted)") == NULL && is_below_folder(path);
}

// Counts an operation. 0: it is to be done; 1: it fails, errno says why. `half` does half of the
// operation, if that makes sense, before the process ends.
static int fails(void (*half)(void*), void* what) {
  uint64_t number = 0;
  if (shim.counter != NULL) number = ++shim.counter[0];
  if (shim.at == 0 || shim.mode == NONE || number < shim.at) return 0;
  if (number > shim.at && shim.mode != FOREVER) return 0;
  ++shim.counter[1];
  if (shim.mode == HALF_EXIT && half != NULL) half(what);
  if (shim.mode == HALF_EXIT || shim.mode == EXIT) syscall(SYS_exit_group, EXIT_BY_FAULT);
  errno = shim.error;
  return 1;
}

// A record: kind (a letter), length of the path, offset and size as 64-bit numbers, the path below
// the folder, the bytes. Kinds: w write, s sync of a file, d sync of a folder, t truncation to
// `offset`, r rename of the path to the one in the bytes, u unlink.
static void write_record(char kind, const char* path, uint64_t offset, const void* bytes,
                         uint64_t size) {
  if (shim.trace < 0) return;
  const int error = errno;
  const char* name = path + shim.folder_length;
  const uint64_t name_length = strlen(name);
  char* record = malloc(25 + name_length + size);
  if (record == NULL) abort();
  record[0] = kind;
  memcpy(record + 1, &name_length, 8);
  memcpy(record + 9, &offset, 8);
  memcpy(record + 17, &size, 8);
  memcpy(record + 25, name, name_length);
  if (size > 0) memcpy(record + 25 + name_length, bytes, size);
  const size_t length = 25 + name_length + size;
  if (real_write(shim.trace, record, length) != (ssize_t)length) abort();
  free(record);
  errno = error;
}

struct write_order {
  int file;
  const void* bytes;
  size_t size;
  off_t offset;  // -1: where the file stands
};

static ssize_t do_write(const struct write_order* order, size_t size) {
  if (order->offset < 0) return real_write(order->file, order->bytes, size);
  return real_pwrite(order->file, order->bytes, size, order->offset);
}

static void write_half(void* what) {
  const struct write_order* order = what;
  (void)!do_write(order, order->size / 2);
}

static uint64_t offset_of(const struct write_order* order) {
  if (order->offset >= 0) return (uint64_t)order->offset;
  const int flags = fcntl(order->file, F_GETFL);
  return (uint64_t)lseek(order->file, 0, (flags & O_APPEND) != 0 ? SEEK_END : SEEK_CUR);
}

static ssize_t watched_write(struct write_order order) {
  begin();
  char path[MAX_PATH];
  if (!path_of(order.file, path)) return do_write(&order, order.size);
  pthread_mutex_lock(&in_order);
  ssize_t written = -1;
  if (!fails(write_half, &order)) {
    const uint64_t offset = offset_of(&order);
    written = do_write(&order, order.size);
    if (written > 0) write_record('w', path, offset, order.bytes, (uint64_t)written);
  }
  pthread_mutex_unlock(&in_order);
  return written;
}

ssize_t write(int file, const void* bytes, size_t size) {
  return watched_write((struct write_order){file, bytes, size, -1});
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t offset) {
  return watched_write((struct write_order){file, bytes, size, offset});
}

ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t offset) {
  return watched_write((struct write_order){file, bytes, size, offset});
}

static int is_folder(int file) {
  struct stat status;
  return fstat(file, &status) == 0 && S_ISDIR(status.st_mode);
}

static int watched_sync(int file, int (*sync)(int)) {
  char path[MAX_PATH];
  if (!path_of(file, path)) return sync(file);
  pthread_mutex_lock(&in_order);
  int result = -1;
  if (!fails(NULL, NULL)) {
    result = sync(file);
    if (result == 0) write_record(is_folder(file) ? 'd' : 's', path, 0, NULL, 0);
  }
  pthread_mutex_unlock(&in_order);
  return result;
}

int fsync(int file) {
  begin();
  return watched_sync(file, real_fsync);
}

int fdatasync(int file) {
  begin();
  return watched_sync(file, real_fdatasync);
}

static int watched_truncation(int file, off_t size) {
  begin();
  char path[MAX_PATH];
  if (!path_of(file, path)) return real_ftruncate(file, size);
  pthread_mutex_lock(&in_order);
  int result = -1;
  if (!fails(NULL, NULL)) {
    result = real_ftruncate(file, size);
    if (result == 0) write_record('t', path, (uint64_t)size, NULL, 0);
  }
  pthread_mutex_unlock(&in_order);
  return result;
}

int ftruncate(int file, off_t size) { return watched_truncation(file, size); }
int ftruncate64(int file, off64_t size) { return watched_truncation(file, size); }

int rename(const char* from, const char* to) {
  begin();
  if (shim.folder == NULL || !is_below_folder(to)) return real_rename(from, to);
  pthread_mutex_lock(&in_order);
  int result = -1;
  if (!fails(NULL, NULL)) {
    result = real_rename(from, to);
    const char* name = to + shim.folder_length;
    if (result == 0) write_record('r', from, 0, name, strlen(name));
  }
  pthread_mutex_unlock(&in_order);
  return result;
}

int unlink(const char* path) {
  begin();
  if (shim.folder == NULL || !is_below_folder(path)) return real_unlink(path);
  pthread_mutex_lock(&in_order);
  int result = -1;
  if (!fails(NULL, NULL)) {
    result = real_unlink(path);
    if (result == 0) write_record('u', path, 0, NULL, 0);
  }
  pthread_mutex_unlock(&in_order);
  return result;
}
