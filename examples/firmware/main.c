/* The torques of a PUMA 560 on a microcontroller: as golden ones to the certified 1e-4 of what
 * the actuators give, inside the box, and what a call takes. */
#include "board.h"
#include "golden.h"
#include "puma560.h"

/* The torques of the actuators, which the tolerance is relative to. */
static const float LARGEST[6] = {97.6F, 186.4F, 89.4F, 24.2F, 20.1F, 21.3F};
static const float TOLERANCE = 1e-4F;
enum { MOST_INSTRUCTIONS = 550 };

static float q[6], qd[6], qdd[6], tau[6];

static void torques(void)
{
    puma560_fw_f32_inverse_dynamics(q, qd, qdd, tau);
}

int firmware(void)
{
    float worst = 0.0F;
    for (int state = 0; state < GOLDEN_STATES; ++state) {
        for (int joint = 0; joint < 6; ++joint) {
            q[joint] = golden_q[state][joint];
            qd[joint] = golden_qd[state][joint];
            qdd[joint] = golden_qdd[state][joint];
        }
        if (!puma560_fw_f32_in_box(q, qd, qdd)) {
            print("a golden state is outside of the box\n");
            return 1;
        }
        torques();
        for (int joint = 0; joint < 6; ++joint) {
            float off = __builtin_fabsf(tau[joint] - golden_tau[state][joint]) / LARGEST[joint];
            worst = off > worst ? off : worst;
            if (!(off <= TOLERANCE)) {
                print("a torque is wrong: state ");
                print_number((unsigned int)state);
                print(", joint ");
                print_number((unsigned int)joint + 1u);
                print("\n");
                return 1;
            }
        }
    }
    print_number(GOLDEN_STATES);
    print(" golden states: torques within ");
    print_number((unsigned int)(worst * 1e9F));
    print("e-9 of the actuators' largest\n");
    cost call = measure(torques);
    print("inverse_dynamics: ");
    print_number(call.instructions);
    print(" instructions, ");
    print_number(call.stack);
    print(" bytes of stack\n");
    if (call.instructions > MOST_INSTRUCTIONS) {
        print("more than 550 instructions\n");
        return 1;
    }
    return 0;
}
