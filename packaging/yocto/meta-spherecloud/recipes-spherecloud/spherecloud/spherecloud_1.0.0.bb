SUMMARY = "Relocalization of headsets from colour and time-of-flight images"
DESCRIPTION = "Says where a device is in a prebuilt map that holds neither geometry nor looks of the place"
SECTION = "libs"
# A candidate, which sorts before the release; a release has the version of the file's name.
PV = "1.0.0~rc1"
LICENSE = "Apache-2.0"
LIC_FILES_CHKSUM = "file://LICENSE;md5=3b83ef96387f14655fc854ddc3c6bd57"

DEPENDS = "highway libeigen"

# The tree that this layer lies in.
inherit externalsrc cmake ptest
EXTERNALSRC = "${@os.path.realpath(os.path.join(d.getVar('THISDIR'), '../../../../..'))}"
SRC_URI = "file://run-ptest"

# Highway's kernels are those of the machine's tune; nothing is linked.  32-bit ARM has single lanes alone.
SPHERECLOUD_SIMD = "static"
SPHERECLOUD_SIMD:arm = "scalar"
EXTRA_OECMAKE = "-DSPHC_HOST=OFF -DSPHC_DRIVERS=OFF -DSPHC_EXAMPLES=OFF -DSPHC_TESTS=OFF -DSPHC_SIMD=${SPHERECLOUD_SIMD}"

# The session of tests/portability is a project of its own.
do_compile_ptest() {
    cmake -S ${S}/tests/portability -B ${B}/portability -G Ninja -DCMAKE_TOOLCHAIN_FILE=${WORKDIR}/toolchain.cmake -DSPHC_SIMD=${SPHERECLOUD_SIMD}
    cmake --build ${B}/portability --target portability_replay
}

do_install_ptest() {
    install -m 0755 ${B}/portability/portability_replay ${D}${PTEST_PATH}/
}

BBCLASSEXTEND = "native"
