#pragma once
/// TEST and EXPECT_* of GoogleTest on hosts; the same words over a static registry where GoogleTest does not
/// compile, so that one test source runs on every machine. On a target a message streamed into an EXPECT is
/// dropped.
#if __STDC_HOSTED__ && !defined(MOREPRO_TARGET_TESTS)
#include <gtest/gtest.h>
#else
namespace morepro::check {

struct Test {
  Test(const char* suite_name, const char* test_name, void (*body)())
      : suite(suite_name), name(test_name), run(body), next(first) {
    first = this;
  }
  const char* suite;
  const char* name;
  void (*run)();
  Test* next;
  static inline constinit Test* first = nullptr;
};

/// Provided by the runner: notes a failure and returns its sink.
struct Sink {
  template <class T>
  const Sink& operator<<(const T&) const {
    return *this;
  }
};
Sink fail(const char* file, int line, const char* expression);

struct Voidify {
  void operator&(const Sink&) const {}
};

}  // namespace morepro::check

#define TEST(suite, test)                                                                     \
  static void suite##_##test##_body();                                                        \
  static ::morepro::check::Test suite##_##test##_entry(#suite, #test, suite##_##test##_body); \
  static void suite##_##test##_body()
#define MOREPRO_EXPECT(condition, text) \
  (condition) ? void() : ::morepro::check::Voidify() & ::morepro::check::fail(__FILE__, __LINE__, text)
#define MOREPRO_ASSERT(condition, text) \
  if (condition) {                      \
  } else                                \
    return ::morepro::check::Voidify() & ::morepro::check::fail(__FILE__, __LINE__, text)
#define EXPECT_TRUE(a) MOREPRO_EXPECT(static_cast<bool>(a), #a)
#define EXPECT_FALSE(a) MOREPRO_EXPECT(!static_cast<bool>(a), "not " #a)
#define EXPECT_EQ(a, b) MOREPRO_EXPECT((a) == (b), #a " == " #b)
#define EXPECT_NE(a, b) MOREPRO_EXPECT((a) != (b), #a " != " #b)
#define EXPECT_LT(a, b) MOREPRO_EXPECT((a) < (b), #a " < " #b)
#define EXPECT_LE(a, b) MOREPRO_EXPECT((a) <= (b), #a " <= " #b)
#define EXPECT_GT(a, b) MOREPRO_EXPECT((a) > (b), #a " > " #b)
#define EXPECT_GE(a, b) MOREPRO_EXPECT((a) >= (b), #a " >= " #b)
#define EXPECT_NEAR(a, b, tolerance) \
  MOREPRO_EXPECT((a) - (b) <= (tolerance) && (b) - (a) <= (tolerance), #a " within " #tolerance " of " #b)
#define ASSERT_TRUE(a) MOREPRO_ASSERT(static_cast<bool>(a), #a)
#define ASSERT_FALSE(a) MOREPRO_ASSERT(!static_cast<bool>(a), "not " #a)
#define ASSERT_EQ(a, b) MOREPRO_ASSERT((a) == (b), #a " == " #b)
#endif
