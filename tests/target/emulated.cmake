# In the host's build: images and programs of the other builds against this one. Builds that are not there are
# reported as skipped, or as failed where MOREPRO_REQUIRE_TARGETS is set in the environment.
set(MOREPRO_BUILDS "${PROJECT_SOURCE_DIR}/build" CACHE PATH "Folder of the preset builds that the tests compare")
set(boards almec mps2-an386 mps2-an500)
set(architectures aarch64 riscv64 s390x)
set(recordings "${CMAKE_CURRENT_BINARY_DIR}/recordings")
file(MAKE_DIRECTORY "${recordings}")

function(morepro_recording name)
  add_test(NAME recording.${name} COMMAND ${ARGN})
  set_tests_properties(recording.${name} PROPERTIES FIXTURES_SETUP recording_${name} TIMEOUT 120)
endfunction()

function(morepro_emulated_test name recording limit_s)
  add_test(NAME ${name} COMMAND "${Python3_EXECUTABLE}" ${ARGN})
  set_tests_properties(${name} PROPERTIES FIXTURES_REQUIRED recording_${recording} TIMEOUT ${limit_s}
    SKIP_RETURN_CODE 77)
endfunction()

morepro_recording(synthetic_long "${Python3_EXECUTABLE}" "${target_scripts}/synthetic_recording.py" 24000
  "${recordings}/synthetic_long.mrec")
morepro_recording(synthetic_short "${Python3_EXECUTABLE}" "${target_scripts}/synthetic_recording.py" 3000
  "${recordings}/synthetic_short.mrec")
set(replayed synthetic_long)
if(TARGET morepro)
  foreach(machine reference thesis)
    morepro_recording(${machine} $<TARGET_FILE:morepro> simulate --machine ${machine} --profile cutting
      --duration 2.4 --rate 10000 --seed 7 --out "${recordings}/${machine}.mrec")
    list(APPEND replayed ${machine})
  endforeach()
  # Long enough for the watch of the gap to name what is wrong: an effect beside those that the monitor knows.
  morepro_recording(gap $<TARGET_FILE:morepro> simulate --machine "${target_scripts}/with_effects.toml" --profile rich
    --effect feed_force_offset=3 --duration 4.6 --rate 10000 --seed 7 --out "${recordings}/gap.mrec")
  list(APPEND replayed gap)
endif()

foreach(board ${boards})
  morepro_emulated_test(uart.${board} synthetic_short 330 "${target_scripts}/uart_test.py" ${board}
    "${MOREPRO_BUILDS}/${board}/firmware/uart" $<TARGET_FILE:replay_bits> "${recordings}/synthetic_short.mrec")
  list(APPEND others "${board}=${MOREPRO_BUILDS}/${board}/firmware/replay")
endforeach()
foreach(architecture ${architectures})
  list(APPEND others "${architecture}=${MOREPRO_BUILDS}/${architecture}/bin/replay_bits")
endforeach()
foreach(recording ${replayed})
  morepro_emulated_test(same_bits.${recording} ${recording} 900 "${target_scripts}/replay_test.py"
    "${recordings}/${recording}.mrec" $<TARGET_FILE:replay_bits> ${others})
endforeach()
