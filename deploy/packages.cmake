# Packages of Debian, by CPack: deploy/make-packages.sh. Their dependencies are what dpkg-shlibdeps finds, and so those of the
# release that they are built on.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME antipode)
set(CPACK_PACKAGE_CONTACT "The Antipode contributors <antipode@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL client server library)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Any driver of Vulkan will do; Mesa's has one for CPUs as well.
set(CPACK_DEBIAN_CLIENT_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd")
set(CPACK_DEBIAN_SERVER_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd")

set(CPACK_DEBIAN_CLIENT_PACKAGE_NAME antipode)
set(CPACK_COMPONENT_CLIENT_DESCRIPTION
"Renderer for light that takes difficult paths
 Vertex connection and merging in Vulkan compute kernels, on one machine or on
 a farm of servers. Results are reproducible to the bit.")
set(CPACK_DEBIAN_SERVER_PACKAGE_NAME antipode-server)
set(CPACK_COMPONENT_SERVER_DESCRIPTION
"Renders blocks of iterations for clients of Antipode
 One server drives one device for any number of clients, which it lets in by a
 shared secret or by certificates.")
set(CPACK_DEBIAN_SERVER_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_SOURCE_DIR}/systemd/postinst)
set(CPACK_DEBIAN_SERVER_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# Static libraries: what they need in turn are the packages that antipode-config.cmake looks for.
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libantipode-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "libassimp-dev, libdraco-dev, libembree-dev, libmeshoptimizer-dev, \
libopenexr-dev, libpng-dev, libpugixml-dev, libssl-dev, libtbb-dev, libturbojpeg0-dev, libvulkan-dev, libwebp-dev, \
nlohmann-json3-dev, pkg-config")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
"Library of the renderer Antipode
 Headers, static libraries, and what find_package(antipode) finds.")
include(CPack)
