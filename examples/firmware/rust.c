/* Runs examples/bare_metal, whose `main` says by 0 that its torques are right. */
#include "board.h"

int main(void);

static int status;

static void run(void)
{
    status = main();
}

int firmware(void)
{
    cost call = measure(run);
    print("bare_metal: ");
    print(status == 0 ? "right, " : "wrong, ");
    print_number(call.instructions);
    print(" instructions, ");
    print_number(call.stack);
    print(" bytes of stack\n");
    return status;
}
