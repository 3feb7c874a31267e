%% Inverted pendulum
% The angle theta is from the vertical downward; N and P are the forces at the pivot, I is about
% the centre of mass.
%
% $$ M\ddot{x}+b\dot{x}+N = F $$
% 
% $$ N= m\ddot{x}+ml\ddot{\theta}\cos\theta-ml\dot{\theta}^2\sin\theta $$
% 
% $$P\sin\theta+N\cos\theta-mg\sin\theta=ml\ddot{\theta}+m\ddot{x}\cos\theta$$
% 
% $$-Pl\sin\theta-Nl\cos\theta=I\ddot{\theta}$$
m = 0.2;
