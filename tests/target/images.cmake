# In a board's own build: every image that can judge itself, and what the images weigh.
function(morepro_image_test image limit_s)
  add_test(NAME target.${image} COMMAND Python3::Interpreter "${target_scripts}/image_test.py"
    ${MOREPRO_BOARD} $<TARGET_FILE:${image}> ${limit_s} ${ARGN})
  math(EXPR timeout "${limit_s} + 30")
  set_tests_properties(target.${image} PROPERTIES TIMEOUT ${timeout})
endfunction()

morepro_image_test(conformance 60)
morepro_image_test(unit 300)
if(TARGET watchdog)
  morepro_image_test(watchdog 60)
endif()
if(TARGET count)
  # One tick of virtual time per instruction: the counts are exact.
  morepro_image_test(count 300 -icount shift=0)
endif()
