/* The declarations of Godot's gdextension_interface.h, of version 4.1, that this extension uses. Written from the
 * published signatures,
 * https://github.com/godotengine/godot-cpp/blob/godot-4.1-stable/gdextension/gdextension_interface.h
 * (Godot Engine contributors, MIT licence): names, order and values are the interface. The extension builds with the
 * engine's own file, too: -DPELAGIC_GDEXTENSION_HEADER=FILE. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    GDEXTENSION_VARIANT_TYPE_NIL = 0,
    GDEXTENSION_VARIANT_TYPE_BOOL = 1,
    GDEXTENSION_VARIANT_TYPE_INT = 2,
    GDEXTENSION_VARIANT_TYPE_FLOAT = 3,
    GDEXTENSION_VARIANT_TYPE_STRING = 4,
    GDEXTENSION_VARIANT_TYPE_VECTOR3 = 9,
    GDEXTENSION_VARIANT_TYPE_VECTOR4 = 12,
    GDEXTENSION_VARIANT_TYPE_AABB = 16,
    GDEXTENSION_VARIANT_TYPE_TRANSFORM3D = 18,
    GDEXTENSION_VARIANT_TYPE_STRING_NAME = 21,
    GDEXTENSION_VARIANT_TYPE_NODE_PATH = 22,
    GDEXTENSION_VARIANT_TYPE_OBJECT = 24,
    GDEXTENSION_VARIANT_TYPE_DICTIONARY = 27,
    GDEXTENSION_VARIANT_TYPE_ARRAY = 28,
    GDEXTENSION_VARIANT_TYPE_PACKED_BYTE_ARRAY = 29,
    GDEXTENSION_VARIANT_TYPE_PACKED_INT32_ARRAY = 30,
    GDEXTENSION_VARIANT_TYPE_PACKED_FLOAT32_ARRAY = 32,
    GDEXTENSION_VARIANT_TYPE_PACKED_VECTOR3_ARRAY = 36,
    GDEXTENSION_VARIANT_TYPE_VARIANT_MAX = 38
} GDExtensionVariantType;

typedef void* GDExtensionVariantPtr;
typedef const void* GDExtensionConstVariantPtr;
typedef void* GDExtensionUninitializedVariantPtr;
typedef void* GDExtensionStringNamePtr;
typedef const void* GDExtensionConstStringNamePtr;
typedef void* GDExtensionStringPtr;
typedef const void* GDExtensionConstStringPtr;
typedef void* GDExtensionUninitializedStringPtr;
typedef void* GDExtensionObjectPtr;
typedef void* GDExtensionTypePtr;
typedef const void* GDExtensionConstTypePtr;
typedef void* GDExtensionUninitializedTypePtr;
typedef int64_t GDExtensionInt;
typedef uint8_t GDExtensionBool;
typedef void* GDExtensionRefPtr;

typedef enum {
    GDEXTENSION_CALL_OK = 0,
    GDEXTENSION_CALL_ERROR_INVALID_ARGUMENT = 2,
    GDEXTENSION_CALL_ERROR_TOO_MANY_ARGUMENTS = 3,
    GDEXTENSION_CALL_ERROR_TOO_FEW_ARGUMENTS = 4
} GDExtensionCallErrorType;

typedef struct {
    GDExtensionCallErrorType error;
    int32_t argument;
    int32_t expected;
} GDExtensionCallError;

typedef void (*GDExtensionVariantFromTypeConstructorFunc)(GDExtensionUninitializedVariantPtr, GDExtensionTypePtr);
typedef void (*GDExtensionTypeFromVariantConstructorFunc)(GDExtensionUninitializedTypePtr, GDExtensionVariantPtr);
typedef void (*GDExtensionPtrConstructor)(GDExtensionUninitializedTypePtr, const GDExtensionConstTypePtr*);
typedef void (*GDExtensionPtrDestructor)(GDExtensionTypePtr);
typedef void* GDExtensionClassInstancePtr;
typedef GDExtensionBool (*GDExtensionClassSet)(GDExtensionClassInstancePtr, GDExtensionConstStringNamePtr,
    GDExtensionConstVariantPtr);
typedef GDExtensionBool (*GDExtensionClassGet)(GDExtensionClassInstancePtr, GDExtensionConstStringNamePtr,
    GDExtensionVariantPtr);
typedef uint64_t (*GDExtensionClassGetRID)(GDExtensionClassInstancePtr);

typedef struct {
    GDExtensionVariantType type;
    GDExtensionStringNamePtr name;
    GDExtensionStringNamePtr class_name;
    uint32_t hint;
    GDExtensionStringPtr hint_string;
    uint32_t usage;
} GDExtensionPropertyInfo;

typedef const GDExtensionPropertyInfo* (*GDExtensionClassGetPropertyList)(GDExtensionClassInstancePtr, uint32_t*);
typedef void (*GDExtensionClassFreePropertyList)(GDExtensionClassInstancePtr, const GDExtensionPropertyInfo*);
typedef GDExtensionBool (*GDExtensionClassPropertyCanRevert)(GDExtensionClassInstancePtr,
    GDExtensionConstStringNamePtr);
typedef GDExtensionBool (*GDExtensionClassPropertyGetRevert)(GDExtensionClassInstancePtr,
    GDExtensionConstStringNamePtr, GDExtensionVariantPtr);
typedef void (*GDExtensionClassNotification)(GDExtensionClassInstancePtr, int32_t);
typedef void (*GDExtensionClassToString)(GDExtensionClassInstancePtr, GDExtensionBool*, GDExtensionStringPtr);
typedef void (*GDExtensionClassReference)(GDExtensionClassInstancePtr);
typedef void (*GDExtensionClassUnreference)(GDExtensionClassInstancePtr);
typedef void (*GDExtensionClassCallVirtual)(GDExtensionClassInstancePtr, const GDExtensionConstTypePtr*,
    GDExtensionTypePtr);
typedef GDExtensionObjectPtr (*GDExtensionClassCreateInstance)(void*);
typedef void (*GDExtensionClassFreeInstance)(void*, GDExtensionClassInstancePtr);
typedef GDExtensionClassCallVirtual (*GDExtensionClassGetVirtual)(void*, GDExtensionConstStringNamePtr);

typedef struct {
    GDExtensionBool is_virtual;
    GDExtensionBool is_abstract;
    GDExtensionClassSet set_func;
    GDExtensionClassGet get_func;
    GDExtensionClassGetPropertyList get_property_list_func;
    GDExtensionClassFreePropertyList free_property_list_func;
    GDExtensionClassPropertyCanRevert property_can_revert_func;
    GDExtensionClassPropertyGetRevert property_get_revert_func;
    GDExtensionClassNotification notification_func;
    GDExtensionClassToString to_string_func;
    GDExtensionClassReference reference_func;
    GDExtensionClassUnreference unreference_func;
    GDExtensionClassCreateInstance create_instance_func;
    GDExtensionClassFreeInstance free_instance_func;
    GDExtensionClassGetVirtual get_virtual_func;
    GDExtensionClassGetRID get_rid_func;
    void* class_userdata;
} GDExtensionClassCreationInfo;

typedef void* GDExtensionClassLibraryPtr;

typedef enum {
    GDEXTENSION_METHOD_FLAG_NORMAL = 1,
    GDEXTENSION_METHOD_FLAGS_DEFAULT = 1
} GDExtensionClassMethodFlags;

typedef enum {
    GDEXTENSION_METHOD_ARGUMENT_METADATA_NONE = 0
} GDExtensionClassMethodArgumentMetadata;

typedef void (*GDExtensionClassMethodCall)(void*, GDExtensionClassInstancePtr, const GDExtensionConstVariantPtr*,
    GDExtensionInt, GDExtensionVariantPtr, GDExtensionCallError*);
typedef void (*GDExtensionClassMethodPtrCall)(void*, GDExtensionClassInstancePtr, const GDExtensionConstTypePtr*,
    GDExtensionTypePtr);

typedef struct {
    GDExtensionStringNamePtr name;
    void* method_userdata;
    GDExtensionClassMethodCall call_func;
    GDExtensionClassMethodPtrCall ptrcall_func;
    uint32_t method_flags;
    GDExtensionBool has_return_value;
    GDExtensionPropertyInfo* return_value_info;
    GDExtensionClassMethodArgumentMetadata return_value_metadata;
    uint32_t argument_count;
    GDExtensionPropertyInfo* arguments_info;
    GDExtensionClassMethodArgumentMetadata* arguments_metadata;
    uint32_t default_argument_count;
    GDExtensionVariantPtr* default_arguments;
} GDExtensionClassMethodInfo;

typedef enum {
    GDEXTENSION_INITIALIZATION_SCENE = 2
} GDExtensionInitializationLevel;

typedef struct {
    GDExtensionInitializationLevel minimum_initialization_level;
    void* userdata;
    void (*initialize)(void*, GDExtensionInitializationLevel);
    void (*deinitialize)(void*, GDExtensionInitializationLevel);
} GDExtensionInitialization;

typedef void (*GDExtensionInterfaceFunctionPtr)();
typedef GDExtensionInterfaceFunctionPtr (*GDExtensionInterfaceGetProcAddress)(const char*);
typedef GDExtensionBool (*GDExtensionInitializationFunction)(GDExtensionInterfaceGetProcAddress,
    GDExtensionClassLibraryPtr, GDExtensionInitialization*);
typedef void (*GDExtensionInterfacePrintError)(const char*, const char*, const char*, int32_t, GDExtensionBool);
typedef void (*GDExtensionInterfaceVariantNewCopy)(GDExtensionUninitializedVariantPtr, GDExtensionConstVariantPtr);
typedef void (*GDExtensionInterfaceVariantNewNil)(GDExtensionUninitializedVariantPtr);
typedef void (*GDExtensionInterfaceVariantDestroy)(GDExtensionVariantPtr);
typedef void (*GDExtensionInterfaceVariantCall)(GDExtensionVariantPtr, GDExtensionConstStringNamePtr, const
    GDExtensionConstVariantPtr*, GDExtensionInt, GDExtensionUninitializedVariantPtr, GDExtensionCallError*);
typedef void (*GDExtensionInterfaceVariantSetKeyed)(GDExtensionVariantPtr, GDExtensionConstVariantPtr,
    GDExtensionConstVariantPtr, GDExtensionBool*);
typedef void (*GDExtensionInterfaceVariantGetKeyed)(GDExtensionConstVariantPtr, GDExtensionConstVariantPtr,
    GDExtensionUninitializedVariantPtr, GDExtensionBool*);
typedef GDExtensionVariantType (*GDExtensionInterfaceVariantGetType)(GDExtensionConstVariantPtr);
typedef GDExtensionVariantFromTypeConstructorFunc
    (*GDExtensionInterfaceGetVariantFromTypeConstructor)(GDExtensionVariantType);
typedef GDExtensionTypeFromVariantConstructorFunc
    (*GDExtensionInterfaceGetVariantToTypeConstructor)(GDExtensionVariantType);
typedef GDExtensionPtrConstructor (*GDExtensionInterfaceVariantGetPtrConstructor)(GDExtensionVariantType, int32_t);
typedef GDExtensionPtrDestructor (*GDExtensionInterfaceVariantGetPtrDestructor)(GDExtensionVariantType);
typedef void (*GDExtensionInterfaceStringNewWithUtf8CharsAndLen)(GDExtensionUninitializedStringPtr, const char*,
    GDExtensionInt);
typedef GDExtensionInt (*GDExtensionInterfaceStringToUtf8Chars)(GDExtensionConstStringPtr, char*, GDExtensionInt);
typedef uint8_t* (*GDExtensionInterfacePackedByteArrayOperatorIndex)(GDExtensionTypePtr, GDExtensionInt);
typedef float* (*GDExtensionInterfacePackedFloat32ArrayOperatorIndex)(GDExtensionTypePtr, GDExtensionInt);
typedef int32_t* (*GDExtensionInterfacePackedInt32ArrayOperatorIndex)(GDExtensionTypePtr, GDExtensionInt);
typedef GDExtensionTypePtr (*GDExtensionInterfacePackedVector3ArrayOperatorIndex)(GDExtensionTypePtr, GDExtensionInt);
typedef GDExtensionObjectPtr (*GDExtensionInterfaceGlobalGetSingleton)(GDExtensionConstStringNamePtr);
typedef void (*GDExtensionInterfaceObjectSetInstance)(GDExtensionObjectPtr, GDExtensionConstStringNamePtr,
    GDExtensionClassInstancePtr);
typedef void (*GDExtensionInterfaceRefSetObject)(GDExtensionRefPtr, GDExtensionObjectPtr);
typedef GDExtensionObjectPtr (*GDExtensionInterfaceClassdbConstructObject)(GDExtensionConstStringNamePtr);
typedef void (*GDExtensionInterfaceClassdbRegisterExtensionClass)(GDExtensionClassLibraryPtr,
    GDExtensionConstStringNamePtr, GDExtensionConstStringNamePtr, const GDExtensionClassCreationInfo*);
typedef void (*GDExtensionInterfaceClassdbRegisterExtensionClassMethod)(GDExtensionClassLibraryPtr,
    GDExtensionConstStringNamePtr, const GDExtensionClassMethodInfo*);
typedef void (*GDExtensionInterfaceClassdbRegisterExtensionClassProperty)(GDExtensionClassLibraryPtr,
    GDExtensionConstStringNamePtr, const GDExtensionPropertyInfo*, GDExtensionConstStringNamePtr,
    GDExtensionConstStringNamePtr);
typedef void (*GDExtensionInterfaceClassdbRegisterExtensionClassSignal)(GDExtensionClassLibraryPtr,
    GDExtensionConstStringNamePtr, GDExtensionConstStringNamePtr, const GDExtensionPropertyInfo*, GDExtensionInt);
typedef void (*GDExtensionInterfaceClassdbUnregisterExtensionClass)(GDExtensionClassLibraryPtr,
    GDExtensionConstStringNamePtr);
#ifdef __cplusplus
}
#endif
