// A library for LD_PRELOAD: runs a program again and again, and in each run makes the n-th call of one kind fail.
//
// The program is loaded once.  Where its main would begin, a line `FOLDER CALL AT FAULT` is read from stdin for
// each run:
//
//   FOLDER   the working folder of the run; FOLDER.out and FOLDER.err get what it says, FOLDER.calls a line
//            `call count` for each kind of call, when main is over
//            FOLDER.chains, where AT is 0, a line `number hash` for each CALL and the chain of its callers
//   CALL     malloc, open, read, write, sync, rename, close, mmap, truncate, mkdir, unlink or ioctl
//   AT       which one fails, from 1; 0 only counts
//   FAULT    a number of errno; the same with a + behind it: all later calls fail too, as on a full disk; `short`:
//            half is read or written; `kill`: the process is killed before the call; `torn`: when half is written
//
// The answer on stdout is a line with what waitpid said.  A run of more than kSeconds is ended by SIGALRM. Programs
// that the run starts are left alone.  Its stderr always works, since the message goes there.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

enum kind { MALLOC, OPEN, READ, WRITE, SYNC, RENAME, CLOSE, MMAP, TRUNCATE, MKDIR, UNLINK, IOCTL, KINDS };
static const char *const kind_names[KINDS] = {"malloc", "open", "read",     "write", "sync",   "rename",
                                              "close",  "mmap", "truncate", "mkdir", "unlink", "ioctl"};

enum { kSeconds = 60 };
enum act { NOTHING, FAIL, SHORT, TORN };

static atomic_bool armed;
static atomic_long calls[KINDS];
static enum kind chosen = KINDS;
static long first_failing;
static bool lasts, kills;
static enum act act = FAIL;
static int error_number;

// The program's main, between what the libraries do before and after.
static int (*program_main)(int, char **, char **);

// Where each call and the chain of its callers go.  Those in the program count, those in its libraries do not.
enum { kDepth = 128 };
static FILE *chains;
static atomic_flag chains_taken = ATOMIC_FLAG_INIT;
static _Thread_local bool notes;  // looking for the callers may itself allocate, and writing may write

// The same in each process, wherever the program lies.
static uint64_t hash_of_callers(void) {
  struct dl_find_object program, object;
  void *callers[kDepth];
  const int count = backtrace(callers, kDepth);
  uint64_t hash = 14695981039346656037u;  // FNV-1a
  if (_dl_find_object((void *)(uintptr_t)program_main, &program) != 0) abort();
  for (int i = 0; i < count; ++i) {
    const bool is_ours =
        _dl_find_object(callers[i], &object) == 0 && object.dlfo_map_start == program.dlfo_map_start;
    if (is_ours) hash = (hash ^ (uint64_t)((char *)callers[i] - (char *)object.dlfo_map_start)) * 1099511628211u;
  }
  return hash;
}

static void note_chain(long call) {
  notes = true;
  const uint64_t hash = hash_of_callers();
  while (atomic_flag_test_and_set(&chains_taken)) continue;
  fprintf(chains, "%ld %016llx\n", call, (unsigned long long)hash);
  atomic_flag_clear(&chains_taken);
  notes = false;
}

static enum act act_now(enum kind kind) {
  if (!atomic_load(&armed) || notes) return NOTHING;
  const long call = atomic_fetch_add(&calls[kind], 1) + 1;
  if (kind != chosen) return NOTHING;
  if (first_failing == 0) {
    note_chain(call);
    return NOTHING;
  }
  if (call != first_failing && !(lasts && call > first_failing)) return NOTHING;
  if (kills) kill(getpid(), SIGKILL);
  errno = error_number;
  return act;
}

static bool fails(enum kind kind) { return act_now(kind) == FAIL; }

static void choose(const char *call, long at, const char *fault) {
  for (int i = 0; i < KINDS; ++i)
    if (strcmp(call, kind_names[i]) == 0) chosen = (enum kind)i;
  first_failing = at;
  lasts = fault[strlen(fault) - 1] == '+';
  kills = strcmp(fault, "kill") == 0;
  error_number = atoi(fault);
  if (strcmp(fault, "short") == 0) act = SHORT;
  if (strcmp(fault, "torn") == 0) act = TORN;
}

static FILE *beside(const char *folder, const char *ending) {
  char path[600];
  snprintf(path, sizeof path, "%s%s", folder, ending);
  return fopen(path, "w");
}

static void redirect(const char *folder, const char *ending, int to) {
  FILE *file = beside(folder, ending);
  if (!file || dup2(fileno(file), to) < 0) abort();
  fclose(file);
}

static void begin_run(const char *folder) {
  redirect(folder, ".out", STDOUT_FILENO);
  redirect(folder, ".err", STDERR_FILENO);
  if (!freopen("/dev/null", "r", stdin) || chdir(folder) != 0) abort();
  alarm(kSeconds);
}

static void write_calls(const char *folder) {
  FILE *file = beside(folder, ".calls");
  if (!file) abort();
  for (int i = 0; i < KINDS; ++i) fprintf(file, "%s %ld\n", kind_names[i], atomic_load(&calls[i]));
  fclose(file);
}

static int run_main(const char *folder, int argc, char **argv, char **environment) {
  begin_run(folder);
  hash_of_callers();  // loads what it needs
  if (first_failing == 0 && !(chains = beside(folder, ".chains"))) abort();
  atomic_store(&armed, true);
  const int status = program_main(argc, argv, environment);
  atomic_store(&armed, false);
  write_calls(folder);
  if (chains) fclose(chains);
  return status;
}

static int serve(int argc, char **argv, char **environment) {
  char folder[512], call[16], fault[16], line[600];
  long at;
  unsetenv("LD_PRELOAD");
  while (fgets(line, sizeof line, stdin)) {
    if (sscanf(line, "%511s %15s %ld %15s", folder, call, &at, fault) != 4) abort();
    const pid_t run = fork();
    if (run == 0) {
      choose(call, at, fault);
      return run_main(folder, argc, argv, environment);
    }
    int status = 0;
    if (run < 0 || waitpid(run, &status, 0) < 0) abort();
    printf("%d\n", status);
    fflush(stdout);
  }
  return 0;
}

#define NEXT(name) (__extension__(__typeof__(&name)) next_of(#name))
static void *next_of(const char *name) { return dlsym(RTLD_NEXT, name); }

typedef int start_main(int (*)(int, char **, char **), int, char **, void (*)(void), void (*)(void), void (*)(void),
                       void *);
start_main __libc_start_main;
int __libc_start_main(int (*main)(int, char **, char **), int argc, char **argv, void (*init)(void),
                      void (*fini)(void), void (*rtld_fini)(void), void *stack_end) {
  program_main = main;
  return NEXT(__libc_start_main)(serve, argc, argv, init, fini, rtld_fini, stack_end);
}

// Memory: dlsym may itself allocate, so the C library's own names are called.  operator new comes here too.
void *__libc_malloc(size_t);
void *__libc_calloc(size_t, size_t);
void *__libc_realloc(void *, size_t);
void *__libc_memalign(size_t, size_t);

void *malloc(size_t size) { return fails(MALLOC) ? NULL : __libc_malloc(size); }
void *calloc(size_t count, size_t size) { return fails(MALLOC) ? NULL : __libc_calloc(count, size); }
void *realloc(void *old, size_t size) { return fails(MALLOC) ? NULL : __libc_realloc(old, size); }
void *aligned_alloc(size_t alignment, size_t size) {
  return fails(MALLOC) ? NULL : __libc_memalign(alignment, size);
}
int posix_memalign(void **out, size_t alignment, size_t size) {
  void *block = fails(MALLOC) ? NULL : __libc_memalign(alignment, size);
  if (!block) return ENOMEM;
  *out = block;
  return 0;
}

// Files by descriptor.
static mode_t mode_of(int flags, va_list rest) {
  return (flags & (O_CREAT | __O_TMPFILE)) ? (mode_t)va_arg(rest, int) : 0;
}

static int open_at(int folder, const char *path, int flags, mode_t mode) {
  return fails(OPEN) ? -1 : (int)syscall(SYS_openat, folder, path, flags, mode);
}

#define OPENS(name)                              \
  int name(const char *path, int flags, ...) {   \
    va_list rest;                                \
    va_start(rest, flags);                       \
    const mode_t mode = mode_of(flags, rest);    \
    va_end(rest);                                \
    return open_at(AT_FDCWD, path, flags, mode); \
  }
OPENS(open)
OPENS(open64)

#define OPENS_AT(name)                                     \
  int name(int folder, const char *path, int flags, ...) { \
    va_list rest;                                          \
    va_start(rest, flags);                                 \
    const mode_t mode = mode_of(flags, rest);              \
    va_end(rest);                                          \
    return open_at(folder, path, flags, mode);             \
  }
OPENS_AT(openat)
OPENS_AT(openat64)

// How much of `size` bytes goes through; -1: none, it fails.
static ssize_t allowed(enum kind kind, int file, size_t size) {
  const enum act now = file == STDERR_FILENO ? NOTHING : act_now(kind);
  if (now == FAIL) return -1;
  return (ssize_t)(now == NOTHING || size < 2 ? size : size / 2);
}

static ssize_t written(ssize_t done) {
  if (act == TORN && chosen == WRITE && first_failing > 0 && atomic_load(&calls[WRITE]) >= first_failing)
    kill(getpid(), SIGKILL);
  return done;
}

ssize_t read(int file, void *bytes, size_t size) {
  const ssize_t part = allowed(READ, file, size);
  return part < 0 ? -1 : syscall(SYS_read, file, bytes, part);
}
ssize_t write(int file, const void *bytes, size_t size) {
  const ssize_t part = allowed(WRITE, file, size);
  return part < 0 ? -1 : written(syscall(SYS_write, file, bytes, part));
}
ssize_t writev(int file, const struct iovec *parts, int count) {
  const ssize_t part = allowed(WRITE, file, 2);
  if (part < 0) return -1;
  // A short one ends behind the first part.
  return written(syscall(SYS_writev, file, parts, part < 2 ? 1 : count));
}

#define READS_AT(name, offset_type)                                         \
  ssize_t name(int file, void *bytes, size_t size, offset_type offset) {    \
    const ssize_t part = allowed(READ, file, size);                         \
    return part < 0 ? -1 : syscall(SYS_pread64, file, bytes, part, offset); \
  }
READS_AT(pread, off_t)
READS_AT(pread64, off64_t)

#define WRITES_AT(name, offset_type)                                                  \
  ssize_t name(int file, const void *bytes, size_t size, offset_type offset) {        \
    const ssize_t part = allowed(WRITE, file, size);                                  \
    return part < 0 ? -1 : written(syscall(SYS_pwrite64, file, bytes, part, offset)); \
  }
WRITES_AT(pwrite, off_t)
WRITES_AT(pwrite64, off64_t)

int fsync(int file) { return fails(SYNC) ? -1 : (int)syscall(SYS_fsync, file); }
int fdatasync(int file) { return fails(SYNC) ? -1 : (int)syscall(SYS_fdatasync, file); }
int syncfs(int file) { return fails(SYNC) ? -1 : (int)syscall(SYS_syncfs, file); }

// Linux closes the file whatever it answers.
int close(int file) {
  const bool failed = fails(CLOSE);
  const int why = errno, status = (int)syscall(SYS_close, file);
  if (failed) errno = why;
  return failed ? -1 : status;
}

int ftruncate(int file, off_t size) { return fails(TRUNCATE) ? -1 : (int)syscall(SYS_ftruncate, file, size); }
int ftruncate64(int file, off64_t size) { return fails(TRUNCATE) ? -1 : (int)syscall(SYS_ftruncate, file, size); }

void *mmap(void *wish, size_t size, int protection, int flags, int file, off_t offset) {
  return fails(MMAP) ? MAP_FAILED : (void *)syscall(SYS_mmap, wish, size, protection, flags, file, offset);
}
void *mmap64(void *wish, size_t size, int protection, int flags, int file, off64_t offset) {
  return fails(MMAP) ? MAP_FAILED : (void *)syscall(SYS_mmap, wish, size, protection, flags, file, offset);
}

int ioctl(int file, unsigned long request, ...) {
  va_list rest;
  va_start(rest, request);
  void *argument = va_arg(rest, void *);
  va_end(rest);
  return fails(IOCTL) ? -1 : (int)syscall(SYS_ioctl, file, request, argument);
}

// Names.
static int rename_at(int from_folder, const char *from, int to_folder, const char *to, unsigned flags) {
  return fails(RENAME) ? -1 : (int)syscall(SYS_renameat2, from_folder, from, to_folder, to, flags);
}
int rename(const char *from, const char *to) { return rename_at(AT_FDCWD, from, AT_FDCWD, to, 0); }
int renameat(int from_folder, const char *from, int to_folder, const char *to) {
  return rename_at(from_folder, from, to_folder, to, 0);
}
int renameat2(int from_folder, const char *from, int to_folder, const char *to, unsigned flags) {
  return rename_at(from_folder, from, to_folder, to, flags);
}

int mkdir(const char *path, mode_t mode) {
  return fails(MKDIR) ? -1 : (int)syscall(SYS_mkdirat, AT_FDCWD, path, mode);
}
int mkdirat(int folder, const char *path, mode_t mode) {
  return fails(MKDIR) ? -1 : (int)syscall(SYS_mkdirat, folder, path, mode);
}

static int unlink_at(int folder, const char *path, int flags) {
  return fails(UNLINK) ? -1 : (int)syscall(SYS_unlinkat, folder, path, flags);
}
int unlink(const char *path) { return unlink_at(AT_FDCWD, path, 0); }
int unlinkat(int folder, const char *path, int flags) { return unlink_at(folder, path, flags); }
int rmdir(const char *path) { return unlink_at(AT_FDCWD, path, AT_REMOVEDIR); }
int remove(const char *path) {
  if (fails(UNLINK)) return -1;
  const int status = (int)syscall(SYS_unlinkat, AT_FDCWD, path, 0);
  return status < 0 && errno == EISDIR ? (int)syscall(SYS_unlinkat, AT_FDCWD, path, AT_REMOVEDIR) : status;
}

// Buffered files: the C library's own calls below them cannot be reached, so these stand for them.
FILE *fopen(const char *path, const char *mode) { return fails(OPEN) ? NULL : NEXT(fopen)(path, mode); }
FILE *fopen64(const char *path, const char *mode) { return fails(OPEN) ? NULL : NEXT(fopen64)(path, mode); }

size_t fwrite(const void *bytes, size_t size, size_t count, FILE *file) {
  const ssize_t part = allowed(WRITE, fileno(file), size * count);
  if (part == (ssize_t)(size * count)) return NEXT(fwrite)(bytes, size, count, file);
  const size_t done = part > 0 ? NEXT(fwrite)(bytes, 1, (size_t)part, file) : 0;
  NEXT(fflush)(file);
  written(0);
  errno = act == FAIL ? error_number : ENOSPC;  // a C library that wrote less says why
  return done / size;
}
int fputs(const char *text, FILE *file) { return fwrite(text, 1, strlen(text), file) == strlen(text) ? 1 : EOF; }
size_t fread(void *bytes, size_t size, size_t count, FILE *file) {
  const ssize_t part = allowed(READ, fileno(file), size * count);
  if (part == (ssize_t)(size * count)) return NEXT(fread)(bytes, size, count, file);
  return part > 0 ? NEXT(fread)(bytes, 1, (size_t)part, file) / size : 0;
}
int fflush(FILE *file) {
  const bool failed = file && fileno(file) != STDERR_FILENO && fails(WRITE);
  return failed ? EOF : NEXT(fflush)(file);
}
int fclose(FILE *file) {
  const bool failed = fails(CLOSE);
  const int why = errno, status = NEXT(fclose)(file);
  if (failed) errno = why;
  return failed ? EOF : status;
}
