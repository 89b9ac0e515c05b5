# cmake -DWHY=TEXT -P skip.cmake: a test that cannot run here says so; where every test must run, it fails.
if(DEFINED ENV{MOREPRO_REQUIRE_TARGETS})
  message(FATAL_ERROR "cannot run: ${WHY}")
endif()
message("skipped: ${WHY}")
