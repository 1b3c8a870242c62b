/* What runs before main on a bare Cortex-M7.  Printing and exit are newlib's, through the emulator's debugger. */
#include <errno.h>
#include <malloc.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

extern char board_stack_top[], board_bss[], board_bss_end[], board_heap_end[];
void initialise_monitor_handles(void); /* of newlib's librdimon */
int main(int argc, char **argv);

__attribute__((noreturn)) void board_reset(void);
void board_reset(void) {
  *(volatile uint32_t *)0xE000ED88u |= 0xFu << 20; /* CPACR: the floating-point unit is on */
  __asm__ volatile("dsb\n\tisb");
  memset(board_bss, 0, (size_t)(board_bss_end - board_bss));
  initialise_monitor_handles();
  exit(main(0, NULL));
}

/* The heap of the tests' own code lies behind what starts as zero, and not below the stack as newlib has it. */
void *_sbrk(ptrdiff_t bytes);
void *_sbrk(ptrdiff_t bytes) {
  static char *next = board_bss_end;
  if (bytes > board_heap_end - next) {
    errno = ENOMEM;
    return (void *)-1;
  }
  next += bytes;
  return next - bytes;
}

/* newlib's aligned_alloc asks for it, and newlib has none. */
int posix_memalign(void **memory, size_t alignment, size_t bytes) {
  *memory = memalign(alignment, bytes);
  return *memory ? 0 : ENOMEM;
}

static __attribute__((noreturn)) void fault(void) { abort(); }

/* Stack, reset, then the faults. */
__attribute__((used, section(".vectors"))) static void *const vectors[16] = {
    board_stack_top, (void *)board_reset, (void *)fault, (void *)fault,
    (void *)fault,   (void *)fault,       (void *)fault};
