using UnityEngine;

namespace Pelagic.Unity
{
    /// <summary>
    /// Shows the droplets of an OceanBehaviour with Spray as particles. The particle system simulates in world space, and
    /// has neither emission nor play on awake; its renderer's material is that of the spray.
    /// </summary>
    public sealed class OceanSpray : MonoBehaviour
    {
        public OceanBehaviour Ocean;
        public ParticleSystem Particles;

        private readonly ParticleSystem.Particle[] particles = new ParticleSystem.Particle[8192];  // at most that many droplets

        // After the Update() of the ocean, which completes the frame.
        private void LateUpdate()
        {
            if (Ocean == null || Particles == null || !Ocean.HasFrame) return;
            var droplets = Ocean.Frame.Droplets;
            var count = System.Math.Min(droplets.Length, particles.Length);
            for (var i = 0; i < count; ++i)
            {
                ref readonly var droplet = ref droplets[i];
                ref var particle = ref particles[i];
                particle.position = new Vector3((float)droplet.PositionXM, (float)droplet.PositionYM, -(float)droplet.PositionZM);
                particle.velocity = new Vector3(droplet.VelocityXMps, droplet.VelocityYMps, -droplet.VelocityZMps);
                particle.startSize = 2 * droplet.RadiusM;
                particle.startColor = new Color32(255, 255, 255, (byte)(255 * droplet.Opacity + 0.5f));
                particle.startLifetime = 1.5f;
                particle.remainingLifetime = 1.5f - droplet.AgeS;
            }
            Particles.SetParticles(particles, count);
        }
    }
}
