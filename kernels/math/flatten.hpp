// A function with all that it calls in one piece, where that is what makes it fast.
#pragma once

// Instrumented by a sanitizer, a loop with all of its law in one function takes many minutes to
// compile.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define BRECCIA_FLATTEN
#else
#define BRECCIA_FLATTEN [[gnu::flatten]]
#endif
