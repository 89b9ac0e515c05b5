# morepro_board_image(NAME SOURCES... [SEMIHOSTING] [LIBM_ALLOWED] [CALLERS_UNNAMED]): one image for the board of
# this build. No image links with an allocator in it: --wrap without any __wrap_* names the caller, no_heap.ld finds
# what got in by another way. LIBM_ALLOWED: for tests that compare with the C library.
set(MOREPRO_FORBIDDEN_CALLS malloc _malloc_r calloc realloc free sbrk _sbrk _Znwj _Znaj _ZdlPv _ZdlPvj)

function(morepro_refuse_heap target)
  target_link_options(${target} PRIVATE "-Wl,-T,${PROJECT_SOURCE_DIR}/toolchains/no_heap.ld")
endfunction()

function(morepro_name_callers_of_heap target)
  list(JOIN MOREPRO_FORBIDDEN_CALLS ",--wrap=" wrapped)
  target_link_options(${target} PRIVATE "-Wl,--wrap=${wrapped}")
endfunction()

function(morepro_refuse_libm target)
  target_link_options(${target} PRIVATE "-Wl,-T,${PROJECT_SOURCE_DIR}/toolchains/no_libm.ld")
endfunction()

function(morepro_board_image name)
  cmake_parse_arguments(image "SEMIHOSTING;LIBM_ALLOWED;CALLERS_UNNAMED" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${image_SOURCES})
  target_link_libraries(${name} PRIVATE morepro_board ${image_LIBRARIES})
  target_compile_options(${name} PRIVATE -fstack-usage -fcallgraph-info=su)
  target_link_options(${name} PRIVATE -Wl,--fatal-warnings "-Wl,-Map=$<TARGET_FILE:${name}>.map")
  morepro_refuse_heap(${name})
  if(NOT image_CALLERS_UNNAMED)
    morepro_name_callers_of_heap(${name})
  endif()
  if(NOT image_LIBM_ALLOWED)
    morepro_refuse_libm(${name})
  endif()
  if(image_SEMIHOSTING)
    target_link_options(${name} PRIVATE --crt0=semihost --oslib=semihost)
  else()
    target_link_options(${name} PRIVATE --crt0=minimal)
  endif()
  add_custom_command(TARGET ${name} POST_BUILD COMMAND arm-none-eabi-size $<TARGET_FILE:${name}> VERBATIM)
endfunction()
