// One loop, compiled for several instruction sets, the best of which is chosen when the program
// runs.
//
//     ARCSTART_FOR_EACH_INSTRUCTION_SET(fold, (const Task& task), (task))
//
// needs an always-inline function template fold_body<kFloats>(task) and defines fold(task).
// kFloats: how many a register holds.
#pragma once

#ifdef ARCSTART_TOGETHER
#error "a source for several instruction sets: list it under APART in its CMakeLists.txt"
#endif

#define ARCSTART_INLINE_BODY [[gnu::always_inline]] static inline

#if defined(__x86_64__) && defined(__GNUC__)
#define ARCSTART_FOR_EACH_INSTRUCTION_SET(name, parameters, arguments)                            \
  [[gnu::target(                                                                                  \
      "avx512f,avx512vl,avx512bw,avx512dq,avx2,fma")]] static void name##_avx512 parameters {     \
    name##_body<16> arguments;                                                                    \
  }                                                                                               \
  [[gnu::target("avx2,fma")]] static void name##_avx2 parameters { name##_body<8> arguments; }    \
  static void name##_baseline parameters { name##_body<4> arguments; }                            \
  static void name parameters {                                                                   \
    static const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); \
    static const bool has_avx512 =                                                                \
        has_avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&    \
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq");                 \
    has_avx512 ? name##_avx512 arguments                                                          \
    : has_avx2 ? name##_avx2 arguments                                                            \
               : name##_baseline arguments;                                                       \
  }
#else
#define ARCSTART_FOR_EACH_INSTRUCTION_SET(name, parameters, arguments) \
  static void name parameters { name##_body<4> arguments; }
#endif
