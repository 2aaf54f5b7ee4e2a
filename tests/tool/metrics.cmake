# SPDX-License-Identifier: BSD-3-Clause
# Tests of the commands noise, compare and render, and of the parts that draw pictures.
find_package(PNG 1.6 REQUIRED)

pcl_gpf_add_test(test_tool_measuring
  SOURCES
    run_tool.cpp
    test_compare.cpp
    test_noise.cpp
    test_render.cpp
  LIBRARIES pcl_gpf::pcl_gpf nlohmann_json::nlohmann_json PNG::PNG
  LABELS tool)
target_compile_definitions(test_tool_measuring PRIVATE PCL_GPF_TOOL_PATH="$<TARGET_FILE:pcl_gpf_tool>")
add_dependencies(test_tool_measuring pcl_gpf_tool)

set(render_folder "${PROJECT_SOURCE_DIR}/tools/render")
pcl_gpf_add_test(test_tool_rasteriser
  SOURCES
    test_rasteriser.cpp
    ${render_folder}/camera.cpp
    ${render_folder}/color_map.cpp
    ${render_folder}/draw_splats.cpp
    ${render_folder}/draw_triangles.cpp
    ${render_folder}/image.cpp
    ${render_folder}/shade_splats.cpp
    ${render_folder}/text.cpp
  LIBRARIES pcl_gpf::core PNG::PNG
  LABELS tool)
target_include_directories(test_tool_rasteriser PRIVATE "${PROJECT_SOURCE_DIR}/tools")
