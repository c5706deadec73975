// One loop, compiled for several instruction sets, the best of which is chosen when the program
// runs.
//
//     ARCSTART_FOR_EACH_INSTRUCTION_SET(fold, (const Task& task), (task))
//
// needs an always-inline function fold_body(task) and defines fold(task).
#pragma once

#if defined(__x86_64__) && defined(__GNUC__)
#define ARCSTART_FOR_EACH_INSTRUCTION_SET(name, parameters, arguments)                            \
  [[gnu::target("avx2,fma")]] static void name##_avx2 parameters { name##_body arguments; }       \
  static void name##_baseline parameters { name##_body arguments; }                               \
  static void name parameters {                                                                   \
    static const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); \
    has_avx2 ? name##_avx2 arguments : name##_baseline arguments;                                 \
  }
#else
#define ARCSTART_FOR_EACH_INSTRUCTION_SET(name, parameters, arguments) \
  static void name parameters { name##_body arguments; }
#endif

#define ARCSTART_INLINE_BODY [[gnu::always_inline]] static inline
