# In a board's own build: every image that can judge itself, and what the images weigh.
function(morepro_image_test image limit_s)
  add_test(NAME target.${image} COMMAND "${Python3_EXECUTABLE}" "${target_scripts}/image_test.py"
    ${MOREPRO_BOARD} $<TARGET_FILE:${image}> ${limit_s} ${ARGN})
  math(EXPR timeout "${limit_s} + 30")
  set_tests_properties(target.${image} PROPERTIES TIMEOUT ${timeout})
endfunction()

morepro_image_test(conformance 60)
morepro_image_test(unit 300)
if(TARGET watchdog)
  morepro_image_test(watchdog 60)
endif()

include(board_image)
set(firmware "${PROJECT_SOURCE_DIR}/firmware")
morepro_board_image(c_interface SOURCES c_interface/main.c "${firmware}/semihosting/semihost.cpp"
  "${firmware}/semihosting/panic_exit.cpp" LIBRARIES morepro_c SEMIHOSTING)
morepro_image_test(c_interface 60)

# Long enough for more than one round of the work on the gap, in contact from a quarter of it on.
set(frames "${CMAKE_CURRENT_BINARY_DIR}/short.mrec")
add_test(NAME recording.short COMMAND "${Python3_EXECUTABLE}" "${target_scripts}/synthetic_recording.py" 24000
  "${frames}")
set_tests_properties(recording.short PROPERTIES FIXTURES_SETUP recording_short TIMEOUT 60)

add_test(NAME target.stack COMMAND "${Python3_EXECUTABLE}" "${PROJECT_SOURCE_DIR}/tests/budget/stack_test.py"
  ${MOREPRO_BOARD} $<TARGET_FILE:replay> "${frames}" "${CMAKE_BINARY_DIR}/firmware/CMakeFiles/replay.dir"
  "${CMAKE_BINARY_DIR}/lib/CMakeFiles")
set_tests_properties(target.stack PROPERTIES FIXTURES_REQUIRED recording_short TIMEOUT 150)
