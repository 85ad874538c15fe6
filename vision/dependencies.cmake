stereobench_need(libopencv-dev OpenCV COMPONENTS core imgproc)
stereobench_need(libfmt-dev fmt)
