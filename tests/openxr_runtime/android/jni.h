// What openxr_platform.h takes of Android's jni.h, so that the application's lines for Android are compiled without an NDK.
#pragma once

using jobject = void*;
