# OpenCV's core and imgproc alone: the package's own configuration comes with a hundred more libraries.
find_path(OPENCV_INCLUDE opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
add_library(windfall_opencv INTERFACE)
target_include_directories(windfall_opencv SYSTEM INTERFACE ${OPENCV_INCLUDE})
foreach(module imgproc core)
  find_library(OPENCV_${module} opencv_${module} REQUIRED)
  target_link_libraries(windfall_opencv INTERFACE ${OPENCV_${module}})
endforeach()
