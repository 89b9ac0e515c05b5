# morepro_board_image(NAME SOURCES... [SEMIHOSTING] [LIBM_ALLOWED]): one image for the board of this build.
# Every image is linked against no_heap.ld, and --wrap without a __wrap_* makes the linker name the caller.
set(MOREPRO_FORBIDDEN_CALLS malloc _malloc_r calloc realloc free sbrk _sbrk _Znwj _Znaj _ZdlPv _ZdlPvj)

function(morepro_board_link_options target)
  list(JOIN MOREPRO_FORBIDDEN_CALLS ",--wrap=" wrapped)
  target_link_options(${target} PRIVATE
    "-T${MOREPRO_LINKER_SCRIPT}" "-L${PROJECT_SOURCE_DIR}/toolchains"
    "-Wl,-T,${PROJECT_SOURCE_DIR}/toolchains/no_heap.ld"
    "-Wl,--wrap=${wrapped}" -Wl,--fatal-warnings "-Wl,-Map=$<TARGET_FILE:${target}>.map")
endfunction()

function(morepro_board_image name)
  cmake_parse_arguments(image "SEMIHOSTING;LIBM_ALLOWED" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${image_SOURCES})
  target_link_libraries(${name} PRIVATE morepro_board ${image_LIBRARIES})
  target_compile_options(${name} PRIVATE -fstack-usage -fcallgraph-info=su)
  morepro_board_link_options(${name})
  if(NOT image_LIBM_ALLOWED)
    target_link_options(${name} PRIVATE "-Wl,-T,${PROJECT_SOURCE_DIR}/toolchains/no_libm.ld")
  endif()
  if(image_SEMIHOSTING)
    target_link_options(${name} PRIVATE --crt0=semihost --oslib=semihost)
  else()
    target_link_options(${name} PRIVATE --crt0=minimal)
  endif()
  add_custom_command(TARGET ${name} POST_BUILD COMMAND arm-none-eabi-size $<TARGET_FILE:${name}> VERBATIM)
endfunction()
