#define DOCTEST_CONFIG_IMPLEMENT  // by name: the header itself may have been read before, precompiled
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
