using Pelagic.Unity;
using Unity.Collections;
using UnityEngine;

/// <summary>
/// Places objects on the water. In a scene of URP: a camera, a directional light, an OceanBehaviour, an OceanSurface
/// with a material of the shader Pelagic/Ocean, and this component with the objects.
/// </summary>
public sealed class Buoys : MonoBehaviour
{
    public OceanBehaviour Ocean;
    public Transform[] Objects;

    private OceanQueries queries;
    private NativeArray<Vector3> positions, normals;
    private NativeArray<float> heights;

    private void OnEnable()
    {
        positions = new NativeArray<Vector3>(Objects.Length, Allocator.Persistent);
        normals = new NativeArray<Vector3>(Objects.Length, Allocator.Persistent);
        heights = new NativeArray<float>(Objects.Length, Allocator.Persistent);
    }

    // After the Update() of the ocean, which completes the frame.
    private void LateUpdate()
    {
        if (!Ocean.HasFrame) return;
        if (queries?.Ocean != Ocean.Ocean)
        {
            queries?.Dispose();
            queries = new OceanQueries(Ocean.Ocean);
        }
        for (var i = 0; i < Objects.Length; ++i) positions[i] = Objects[i].position;
        queries.Schedule(positions, heights, normals);
        queries.Complete();
        for (var i = 0; i < Objects.Length; ++i)
        {
            Objects[i].position = new Vector3(positions[i].x, heights[i], positions[i].z);
            Objects[i].up = normals[i];
        }
    }

    private void OnDisable()
    {
        queries?.Dispose();
        queries = null;
        positions.Dispose();
        normals.Dispose();
        heights.Dispose();
    }
}
