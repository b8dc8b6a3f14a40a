# The rooms: one folder each under tanglebin/. A room may include headers of its own and of the rooms listed here, and no
# others; tests/rooms holds this, and that docs/architecture.md shows the same list.
#
#   tanglebin_room(FOLDER TARGET library ROOMS room...)
#
# The sources of all rooms of a TARGET make one library (tanglebin/CMakeLists.txt).
set(tanglebin_rooms)
macro(tanglebin_room folder)
  cmake_parse_arguments(room "" "TARGET" "ROOMS" ${ARGN})
  list(APPEND tanglebin_rooms ${folder})
  set(tanglebin_target_of_${folder} ${room_TARGET})
  set(tanglebin_rooms_of_${folder} ${room_ROOMS})
endmacro()

# Sets `variable` to the sources of all rooms of a target.
function(tanglebin_sources_of target variable)
  foreach(room IN LISTS tanglebin_rooms)
    if(tanglebin_target_of_${room} STREQUAL target)
      file(GLOB room_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tanglebin/${room}/*.cpp)
      list(APPEND sources ${room_sources})
    endif()
  endforeach()
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

tanglebin_room(base                 TARGET core)
tanglebin_room(files                TARGET core        ROOMS base)
tanglebin_room(geometry             TARGET core        ROOMS base)
tanglebin_room(cloud                TARGET core        ROOMS base geometry)
tanglebin_room(io                   TARGET core        ROOMS base files geometry cloud)

tanglebin_room(model/scene          TARGET axis        ROOMS base geometry cloud)
tanglebin_room(model/locate         TARGET axis        ROOMS base geometry cloud)
tanglebin_room(model/axis/settings  TARGET axis        ROOMS model/scene)
tanglebin_room(model/axis/fragments TARGET axis        ROOMS base geometry model/scene model/axis/settings)
tanglebin_room(model/axis/links     TARGET axis        ROOMS base geometry model/scene model/axis/settings
                                                             model/axis/fragments)
tanglebin_room(model/axis           TARGET axis        ROOMS base geometry cloud model/scene model/axis/settings
                                                             model/axis/fragments model/axis/links)
tanglebin_room(model/paper          TARGET paper       ROOMS base geometry cloud model/scene)
tanglebin_room(model                TARGET modelling   ROOMS base geometry cloud model/scene model/axis/settings
                                                             model/axis model/paper)
tanglebin_room(profile              TARGET modelling   ROOMS base files geometry model/scene model)
tanglebin_room(scene                TARGET modelling   ROOMS base files geometry cloud io model/scene model/locate
                                                             model/axis)
tanglebin_room(score                TARGET modelling   ROOMS base geometry cloud)

tanglebin_room(generate             TARGET simulation  ROOMS base geometry)
tanglebin_room(settle               TARGET simulation  ROOMS base geometry)
tanglebin_room(scan                 TARGET simulation  ROOMS base geometry cloud)
tanglebin_room(recipe               TARGET simulation  ROOMS base files geometry io generate settle scan)
tanglebin_room(simulate             TARGET simulation  ROOMS base geometry cloud generate settle scan recipe)

tanglebin_room(runs                 TARGET datasets    ROOMS base files)
tanglebin_room(dataset              TARGET datasets    ROOMS base files geometry cloud io settle scan recipe simulate
                                                             runs)
tanglebin_room(experiment           TARGET datasets    ROOMS base files geometry cloud io model/scene model/axis/links
                                                             model/axis model scene score recipe runs dataset)
tanglebin_room(calibrate            TARGET datasets    ROOMS base files geometry model profile scan recipe runs dataset
                                                             experiment)
tanglebin_room(pictures             TARGET datasets    ROOMS base geometry cloud model/axis model/paper scan)
tanglebin_room(report               TARGET datasets    ROOMS base files geometry cloud io model/scene score recipe
                                                             dataset experiment pictures)
tanglebin_room(export               TARGET exports     ROOMS base files geometry cloud io settle scan recipe runs
                                                             dataset)
tanglebin_room(cli/terminal         TARGET program     ROOMS base files runs dataset report)
tanglebin_room(cli/options          TARGET program     ROOMS base files geometry cloud io model/scene model profile
                                                             scene recipe runs dataset experiment report cli/terminal)
tanglebin_room(cli                  TARGET program     ROOMS base files geometry cloud io model profile scene score scan
                                                             recipe runs dataset experiment calibrate pictures report
                                                             export cli/terminal cli/options)
