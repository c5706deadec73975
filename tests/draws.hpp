// How many draws a case makes.
#pragma once

namespace arcstart::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

// Under the sanitizers, some seven times slower, one draw goes through the same code as all.
constexpr int draws(int many) { return sanitized ? 1 : many; }

}  // namespace arcstart::test
