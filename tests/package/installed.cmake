cmake_minimum_required(VERSION 3.25)

# Installs what BUILD holds, then configures, builds and runs examples/minimal against it.
set(work ${BUILD}/tests/package)
file(REMOVE_RECURSE ${work})

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/installed)
run(${CMAKE_COMMAND} -S ${SOURCE}/examples/minimal -B ${work}/minimal -G ${GENERATOR}
    -D CMAKE_PREFIX_PATH=${work}/installed -D CMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${work}/minimal)

execute_process(COMMAND ${work}/minimal/minimal OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
message("${output}")
if(NOT output MATCHES "^[1-9][0-9]* points on 3 tubes\n$")
  message(FATAL_ERROR "found the output above, expected a number of points on 3 tubes")
endif()

run(${work}/installed/bin/tanglebin --version)

# Models a scan of the minimal example's scene.
run(${CMAKE_COMMAND} -S ${SOURCE}/examples/model_a_scan -B ${work}/model_a_scan -G ${GENERATOR}
    -D CMAKE_PREFIX_PATH=${work}/installed -D CMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${work}/model_a_scan)
run(${work}/installed/bin/tanglebin generate ${SOURCE}/recipes/set-a.toml --out ${work}/dataset --tubes 3 --cases 1)
execute_process(COMMAND ${work}/model_a_scan/model_a_scan ${work}/dataset/A3/plys/1.ply ${SOURCE}/scenes/paper.toml
                OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
message("${output}")
if(NOT output MATCHES "tube 3: ")
  message(FATAL_ERROR "found the output above, expected three tubes")
endif()

# Scores the example of an algorithm on it.
run(${CMAKE_COMMAND} -S ${SOURCE}/examples/score_my_algorithm -B ${work}/score_my_algorithm -G ${GENERATOR}
    -D CMAKE_PREFIX_PATH=${work}/installed -D CMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${work}/score_my_algorithm)
execute_process(COMMAND ${work}/score_my_algorithm/score_my_algorithm ${work}/dataset/A3/plys/1.ply
                OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
message("${output}")
if(NOT output MATCHES "micro-recall (0\\.[0-9]+|1)\n$")
  message(FATAL_ERROR "found the output above, expected a micro-recall")
endif()

# A program that only models needs nothing of the simulation.
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/package/modelling -B ${work}/modelling -G ${GENERATOR}
    -D CMAKE_PREFIX_PATH=${work}/installed -D CMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${work}/modelling)
run(${work}/modelling/modelling)
execute_process(COMMAND ldd ${work}/modelling/modelling OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
if(libraries MATCHES "libode|libembree|libcrypto")
  message(FATAL_ERROR "a program that models links the simulation:\n${libraries}")
endif()
if(libraries MATCHES "libpcl_(features|segmentation)")
  message(FATAL_ERROR "a program that models waits for the Point Cloud Library to be loaded (cmake/pcl.cmake):\n${libraries}")
endif()

# Each public header compiles by itself, with nothing but what is installed.
set(headers ${work}/headers)
file(GLOB_RECURSE installed RELATIVE ${work}/installed/include ${work}/installed/include/*.hpp)
file(WRITE ${headers}/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)\nproject(headers LANGUAGES CXX)\n"
     "find_package(tanglebin REQUIRED)\nfile(GLOB sources *.cpp)\nadd_library(headers OBJECT \${sources})\n"
     "target_link_libraries(headers PRIVATE tanglebin::datasets)\n")
foreach(header IN LISTS installed)
  string(REPLACE "/" "_" name ${header})
  file(WRITE ${headers}/${name}.cpp "#include \"${header}\"\n")
endforeach()
run(${CMAKE_COMMAND} -S ${headers} -B ${headers}/build -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${work}/installed)
run(${CMAKE_COMMAND} --build ${headers}/build)
