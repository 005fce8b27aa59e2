// The stand-in rejects calls that the specification forbids, so an application that passes calls
// the API correctly. Each error code is listed in the reference page of the call.
#include <gtest/gtest.h>

#include <cstdlib>

#include "pelagic/examples/openxr_application/egl_context.hpp"
#include "pelagic/examples/openxr_application/headset.hpp"

namespace {

using namespace openxr_application;

class OpenXrStandIn : public testing::Test {
   protected:
    OpenXrStandIn() { headset_.start(context_.binding()); }

    /// Starts a session whose first frames have ended and whose images are visible.
    void run() {
        ASSERT_TRUE(headset_.handle_events());
        headset_.wait_frame();
        headset_.begin_frame();
        headset_.end_frame(1, nullptr);
    }
    XrSwapchainCreateInfo swapchain_info() const {
        return {.type = XR_TYPE_SWAPCHAIN_CREATE_INFO,
                .usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT,
                .format = GL_SRGB8_ALPHA8,
                .sampleCount = 1,
                .width = 16,
                .height = 16,
                .faceCount = 1,
                .arraySize = 2,
                .mipCount = 1};
    }

    static constexpr XrSwapchainImageWaitInfo patience{.type = XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO,
                                                       .timeout = XR_INFINITE_DURATION};
    EglContext context_;
    Headset headset_;
};

TEST_F(OpenXrStandIn, RequiresFramesInOrder) {
    XrFrameState state{.type = XR_TYPE_FRAME_STATE};
    EXPECT_EQ(xrWaitFrame(headset_.session(), nullptr, &state), XR_ERROR_SESSION_NOT_RUNNING);
    EXPECT_EQ(xrEndSession(headset_.session()), XR_ERROR_SESSION_NOT_RUNNING);
    EXPECT_EQ(xrRequestExitSession(headset_.session()), XR_ERROR_SESSION_NOT_RUNNING);
    run();
    EXPECT_EQ(xrEndSession(headset_.session()), XR_ERROR_SESSION_NOT_STOPPING);
    const XrSessionBeginInfo again{.type = XR_TYPE_SESSION_BEGIN_INFO,
                                   .primaryViewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO};
    EXPECT_EQ(xrBeginSession(headset_.session(), &again), XR_ERROR_SESSION_RUNNING);
    EXPECT_EQ(xrBeginFrame(headset_.session(), nullptr), XR_ERROR_CALL_ORDER_INVALID);
    XrFrameEndInfo end{
        .type = XR_TYPE_FRAME_END_INFO, .displayTime = 1, .environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE};
    EXPECT_EQ(xrEndFrame(headset_.session(), &end), XR_ERROR_CALL_ORDER_INVALID);
    headset_.wait_frame();
    headset_.begin_frame();
    headset_.wait_frame();
    EXPECT_EQ(xrBeginFrame(headset_.session(), nullptr), XR_FRAME_DISCARDED);
    end.displayTime = 0;
    EXPECT_EQ(xrEndFrame(headset_.session(), &end), XR_ERROR_TIME_INVALID);
    end.displayTime = 1;
    end.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_ADDITIVE;
    EXPECT_EQ(xrEndFrame(headset_.session(), &end), XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED);
    end.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
    EXPECT_EQ(xrEndFrame(headset_.session(), &end), XR_SUCCESS);
}

TEST_F(OpenXrStandIn, RequiresImagesInOrder) {
    XrSwapchainCreateInfo info = swapchain_info();
    Owned<XrSwapchain, xrDestroySwapchain> swapchain, refused;
    info.format = GL_RGB565;
    EXPECT_EQ(xrCreateSwapchain(headset_.session(), &info, refused.receive()), XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED);
    info = swapchain_info();
    ASSERT_EQ(xrCreateSwapchain(headset_.session(), &info, swapchain.receive()), XR_SUCCESS);
    std::uint32_t image = 9;
    EXPECT_EQ(xrWaitSwapchainImage(swapchain, &patience), XR_ERROR_CALL_ORDER_INVALID);
    EXPECT_EQ(xrReleaseSwapchainImage(swapchain, nullptr), XR_ERROR_CALL_ORDER_INVALID);
    ASSERT_EQ(xrAcquireSwapchainImage(swapchain, nullptr, &image), XR_SUCCESS);
    // not waited for yet
    EXPECT_EQ(xrReleaseSwapchainImage(swapchain, nullptr), XR_ERROR_CALL_ORDER_INVALID);
    ASSERT_EQ(xrWaitSwapchainImage(swapchain, &patience), XR_SUCCESS);
    EXPECT_EQ(xrWaitSwapchainImage(swapchain, &patience), XR_ERROR_CALL_ORDER_INVALID);
    EXPECT_EQ(xrAcquireSwapchainImage(swapchain, nullptr, &image), XR_SUCCESS);
    EXPECT_EQ(xrAcquireSwapchainImage(swapchain, nullptr, &image), XR_SUCCESS);
    // there are three images
    EXPECT_EQ(xrAcquireSwapchainImage(swapchain, nullptr, &image), XR_ERROR_CALL_ORDER_INVALID);
    EXPECT_EQ(xrReleaseSwapchainImage(swapchain, nullptr), XR_SUCCESS);
}

TEST_F(OpenXrStandIn, ChecksTheSubmittedLayers) {
    run();
    Owned<XrSwapchain, xrDestroySwapchain> swapchain;
    const XrSwapchainCreateInfo info = swapchain_info();
    ASSERT_EQ(xrCreateSwapchain(headset_.session(), &info, swapchain.receive()), XR_SUCCESS);
    XrCompositionLayerProjectionView views[2];
    for (XrCompositionLayerProjectionView& view : views)
        view = {.type = XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW,
                .pose = {.orientation = {0, 0, 0, 1}},
                .subImage = {.swapchain = swapchain, .imageRect = {.extent = {16, 16}}}};
    XrCompositionLayerProjection layer{
        .type = XR_TYPE_COMPOSITION_LAYER_PROJECTION, .space = headset_.space(), .viewCount = 2, .views = views};
    headset_.wait_frame();
    headset_.begin_frame();
    const auto end = [&] {
        const auto* const header = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer);
        const XrFrameEndInfo all{.type = XR_TYPE_FRAME_END_INFO,
                                 .displayTime = 1,
                                 .environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE,
                                 .layerCount = 1,
                                 .layers = &header};
        return xrEndFrame(headset_.session(), &all);
    };
    EXPECT_EQ(end(), XR_ERROR_LAYER_INVALID);  // no image has been released yet
    std::uint32_t image = 0;
    xrAcquireSwapchainImage(swapchain, nullptr, &image);
    xrWaitSwapchainImage(swapchain, &patience);
    EXPECT_EQ(end(), XR_ERROR_LAYER_INVALID);
    xrReleaseSwapchainImage(swapchain, nullptr);
    views[1].subImage.imageRect.extent.width = 17;
    EXPECT_EQ(end(), XR_ERROR_SWAPCHAIN_RECT_INVALID);
    views[1].subImage.imageRect.extent.width = 16;
    views[1].subImage.imageArrayIndex = 2;
    EXPECT_EQ(end(), XR_ERROR_VALIDATION_FAILURE);
    views[1].subImage.imageArrayIndex = 1;
    views[1].pose.orientation.w = 0;
    EXPECT_EQ(end(), XR_ERROR_POSE_INVALID);
    views[1].pose.orientation.w = 1;
    layer.viewCount = 1;
    EXPECT_EQ(end(), XR_ERROR_VALIDATION_FAILURE);
    layer.viewCount = 2;
    EXPECT_EQ(end(), XR_SUCCESS);
}

}  // namespace
