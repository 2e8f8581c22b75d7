# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# The demo in a container: nothing is installed on your system. The report appears in the folder ./report:
#   docker build -t stillpoint .
#   docker run --rm -v "$PWD/report:/stillpoint/build/demo/report" stillpoint
# stillpoint_run is in it, too, for your own recording:
#   docker run --rm -v "$PWD:/data" -w /data stillpoint stillpoint_run --tum FOLDER --out OUT
# Built and run by buildah (chroot isolation) on a bare Debian 12 from debootstrap, the command without a network. Docker itself has
# not been tried.
FROM debian:12

# The packages of examples/demo.sh (tests/structure/packages.sh compares them), in a layer of their own: a change of the
# sources does not download them again.
RUN apt-get update \
 && apt-get install -y --no-install-recommends \
      g++ cmake ninja-build libopencv-dev libeigen3-dev libyaml-cpp-dev libcli11-dev nlohmann-json3-dev \
 && rm -rf /var/lib/apt/lists/*

WORKDIR /stillpoint
COPY . .
# Builds the program and runs nothing.
RUN bash examples/demo.sh --version \
 && ln -s /stillpoint/build/demo/examples/stillpoint_run /usr/local/bin/

CMD ["bash", "examples/demo.sh"]
