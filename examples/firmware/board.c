/* A Cortex-M4F as QEMU has it (mps2-an386): start, semihosting, and what a call takes. */
#include "board.h"

#include <stdint.h>

extern uint32_t data_load[], data_start[], data_end[], bss_start[], bss_end[], stack_top[];

#define CPACR (*(volatile uint32_t *)0xE000ED88u)
#define SYST_CSR (*(volatile uint32_t *)0xE000E010u)
#define SYST_RVR (*(volatile uint32_t *)0xE000E014u)
#define SYST_CVR (*(volatile uint32_t *)0xE000E018u)

/* QEMU, told `-icount shift=0`, takes 1 ns for an instruction, and SysTick counts at 25 MHz. */
enum { INSTRUCTIONS_PER_TICK = 40, CALLS = 4000, PAINTED = 8192 };

static uint32_t semihosting(uint32_t operation, const void *argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

void print(const char *text)
{
    (void)semihosting(0x04u, text);
}

void print_number(unsigned int number)
{
    char digits[11];
    int at = 10;
    digits[at] = '\0';
    do {
        digits[--at] = (char)('0' + number % 10u);
        number /= 10u;
    } while (number != 0u);
    print(&digits[at]);
}

static void exit_with(int status)
{
    /* What a program that ended well says; all else is a failure. */
    (void)semihosting(0x18u, (const void *)(status == 0 ? 0x20026u : 0x20023u));
    for (;;) {
    }
}

static void nothing(void)
{
    __asm__ volatile("");
}

static __attribute__((noinline)) unsigned int ticks(void (*volatile call)(void))
{
    SYST_CVR = 0u;
    uint32_t start = SYST_CVR;
    for (int i = 0; i < CALLS; ++i) {
        call();
    }
    return (start - SYST_CVR) & 0xFFFFFFu;
}

/* Paints what is below the stack, calls, and looks how far the paint is gone. */
static __attribute__((noinline)) unsigned int stack(void (*volatile call)(void))
{
    volatile uint8_t *top;
    __asm__ volatile("mov %0, sp" : "=r"(top));
    for (volatile uint8_t *at = top - PAINTED; at < top; ++at) {
        *at = 0xA5u;
    }
    call();
    volatile uint8_t *low = top - PAINTED;
    while (low < top && *low == 0xA5u) {
        ++low;
    }
    return (unsigned int)(top - low);
}

cost measure(void (*call)(void))
{
    unsigned int most = ticks(call), least = ticks(nothing);
    cost found;
    /* `nothing` is a branch there and a branch back, which a call has too. */
    found.instructions = ((most - least) * INSTRUCTIONS_PER_TICK + CALLS / 2) / CALLS + 2u;
    found.stack = stack(call);
    return found;
}

static void reset(void)
{
    /* The floating point unit is off at first. */
    CPACR |= 0xFu << 20;
    __asm__ volatile("dsb\n isb");
    for (uint32_t *to = data_start, *from = data_load; to < data_end;) {
        *to++ = *from++;
    }
    for (uint32_t *to = bss_start; to < bss_end;) {
        *to++ = 0u;
    }
    SYST_RVR = 0xFFFFFFu;
    SYST_CVR = 0u;
    /* The processor's clock, no interrupt. */
    SYST_CSR = 5u;
    exit_with(firmware());
}

static void fault(void)
{
    print("fault\n");
    exit_with(1);
}

__attribute__((section(".vectors"))) const void *const vectors[16] = {
    stack_top, (const void *)reset, (const void *)fault, (const void *)fault,
    (const void *)fault, (const void *)fault, (const void *)fault,
};
