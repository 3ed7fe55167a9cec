# Every target does all of its own set-up, also on a bare Debian 12 machine.
.DEFAULT_GOAL := help
.NOTPARALLEL:
.PHONY: help build run test bench format clean

JOBS ?= $(shell nproc)
PROGRAM := build/release/bin/icome

help:  ## list these targets
	@sed -n 's/^\([a-z]*\):.*## /  make \1\t/p' $(firstword $(MAKEFILE_LIST)) | expand -t 16

build:  ## the program, build/release/bin/icome
	tools/install-packages build
	cmake --preset release
	cmake --build --preset release -j $(JOBS) --target icome

run: build  ## open the demo in the window; without a display, draw it to demo.png
	tools/install-packages run
	@if [ -n "$$DISPLAY$$WAYLAND_DISPLAY" ]; then \
	  echo "$(PROGRAM) data/demo.wrl" && $(PROGRAM) data/demo.wrl; \
	else \
	  $(PROGRAM) shot data/demo.wrl demo.png && \
	  echo "There is no display for the window (DISPLAY is not set), so demo.png shows the demo design."; \
	fi

test:  ## every check: layout, names, layers, unit and program tests, sanitizers
	tools/install-packages
	tools/check -j $(JOBS)

bench:  ## compare ourselves with the naive ways and with packaged peers
	tools/install-packages build run bench
	cmake --preset release -DICOME_BUILD_BENCHMARKS=ON -DICOME_OPTIMISE_BENCHMARKS=ON
	cmake --build --preset release -j $(JOBS) --target bench

format:  ## lay out every C++ file
	tools/install-packages test
	tools/check-format --fix

clean:  ## remove what was built
	rm -rf build demo.png
