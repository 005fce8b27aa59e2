// The types of Android's jni.h that openxr_platform.h needs, so that the application's code for
// Android is compiled without an NDK.
#pragma once

using jobject = void*;
