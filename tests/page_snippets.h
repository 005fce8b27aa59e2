/* Names that C code blocks of pages use without declaring them, for page_snippets_test.py. */
#include <pelagic/pelagic.h>

extern pelagic_executor* executor;
extern pelagic_ocean* ocean;
extern void* engine;
extern uint32_t engine_threads;
int running(void);
void die(const char* line);
void draw(pelagic_ocean* ocean, const pelagic_frame* frame);
void engine_parallel_for(void* user, size_t count, void (*job)(void* work, size_t index), void* work);
void engine_run_soon(void* user, void (*task)(void* work), void* work);
