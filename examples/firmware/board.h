/* What the board does for the programs of this folder. */
#ifndef BOARD_H
#define BOARD_H

/* What a program runs; 0 if all is well. */
int firmware(void);

/* Prints on the terminal of the debugger or emulator. */
void print(const char *text);
void print_number(unsigned int number);

/* What a call takes. */
typedef struct {
    unsigned int instructions;
    unsigned int stack; /* bytes */
} cost;

/* Measures a call by repeating it. */
cost measure(void (*call)(void));

#endif
